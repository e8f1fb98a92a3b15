// SPDX-License-Identifier: MIT
/// "joints".
#include "reader/drafts.h"

namespace plumb::reader {

namespace {

void read_linked_bodies(JointDraft& draft, const Node& node) {
    if (!node.json().is_array() || node.size() < 1 || node.size() > 2) {
        node.fail_wanting("a list of two bodies, or of one that is joined to the world");
    }
    const Names& names = draft.scene->bodies;
    draft.spec.body_a = names.find(node.at(0));
    if (node.size() == 2) draft.spec.body_b = names.find(node.at(1));

    // A joint must have something to move.
    const auto& bodies = draft.scene->scene.bodies;
    const auto movable = [&](std::uint32_t i) {
        return i != kNoIndex && bodies[i].motion == Motion::dynamic;
    };
    if (draft.spec.body_a == draft.spec.body_b) node.fail("a body cannot be joined to itself");
    if (!movable(draft.spec.body_a) && !movable(draft.spec.body_b)) {
        node.fail("at least one of the joined bodies must be dynamic");
    }
}

}  // namespace

const Table<JointDraft>& joint_table() {
    using J = JointDraft;
    static const Table<J> table = {
        field<J>(
            "name", Text{}, [](J & j) -> auto& { return j.spec.name; },
            "name in errors and recordings"),
        field<J>(
            "type", Choice<JointKind>{{{"ball", JointKind::ball}}},
            [](J & j) -> auto& { return j.spec.kind; }, "kind of joint; ball: one common point",
            Presence::required),
        special<J>(
            "bodies",
            {{"type", "array"}, {"items", Text{}.schema()}, {"minItems", 1}, {"maxItems", 2}},
            read_linked_bodies, "names of the linked bodies; one alone is joined to the world",
            Presence::required),
        field<J>(
            "anchor", Vector3{kCoordinate}, [](J & j) -> auto& { return j.spec.anchor; },
            "common point at the start, world frame [m]", Presence::required),
        field<J>(
            "collide", Flag{}, [](J & j) -> auto& { return j.spec.collide; },
            "whether the linked bodies collide with each other"),
    };
    return table;
}

void read_joints(SceneDraft& draft, const Node& node) {
    if (!node.json().is_array()) node.fail_wanting("a list of joints");
    Names names("joint");
    auto& joints = draft.scene.joints;
    for (std::size_t i = 0; i < node.size(); ++i) {
        JointDraft joint{&draft, {}};
        joint.spec.name = "joint_" + std::to_string(i + 1);
        read_object(joint, node.at(i), joint_table());
        names.add(joint.spec.name, static_cast<std::uint32_t>(i), node.at(i));
        joints.push_back(joint.spec);
    }
}

}  // namespace plumb::reader
