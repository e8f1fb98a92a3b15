// SPDX-License-Identifier: MIT
/// "couplings".
#include <algorithm>
#include <array>

#include "reader/drafts.h"
#include "reader/joints/joint_kinds.h"
#include "scene/joint_faults.h"

namespace plumb::reader {

namespace {

constexpr Range kRatio{-1e9, 1e9};

/// The axes of a joint that can be tied to others.
std::vector<NamedAxis> free_axes(const JointSpec& joint) {
    std::vector<NamedAxis> axes;
    for (const NamedAxis& axis : traits_of(joint.kind).axes) {
        if (is_free(joint, axis.second)) axes.push_back(axis);
    }
    return axes;
}

const JointSpec& joint_of(const CouplingDraft& draft, std::size_t side) {
    const CouplingSpec& spec = draft.spec;
    return draft.scene->scene.joints[side == 0 ? spec.joint_a : spec.joint_b];
}

std::string in_words(const JointSpec& joint) {
    return "joint \"" + joint.name + "\" of type " + traits_of(joint.kind).name;
}

/// The axis that is meant where none is named.
JointAxis only_axis(const CouplingDraft& draft, std::size_t side, const Node& node) {
    const JointSpec& joint = joint_of(draft, side);
    const auto axes = free_axes(joint);
    if (axes.empty())
        node.at(side).fail(in_words(joint) + " has no free axis that could be coupled");
    if (axes.size() > 1 && !traits_of(joint.kind).has_main_axis)
        node.at(side).fail(in_words(joint) +
                           " is free in several axes; name one for each joint in \"axes\"" +
                           advice("", names_of_axes(axes)));
    return axes.front().second;
}

void read_coupled_joints(CouplingDraft& draft, const Node& node) {
    require_list(node, 2, "names of joints");
    draft.spec.joint_a = draft.scene->joints.find(node.at(0));
    draft.spec.joint_b = draft.scene->joints.find(node.at(1));
}

void read_coupled_axes(CouplingDraft& draft, const Node& node) {
    require_list(node, 2, "names of axes");
    for (std::size_t side : {0, 1}) {
        const JointSpec& joint = joint_of(draft, side);
        const auto axes = free_axes(joint);
        if (axes.empty())
            node.at(side).fail(in_words(joint) + " has no free axis that could be coupled");
        const std::string name = Text{}.read(node.at(side));
        const auto found = std::find_if(axes.begin(), axes.end(),
                                        [&](const NamedAxis& axis) { return axis.first == name; });
        if (found == axes.end())
            node.at(side).fail(in_words(joint) + " is not free in \"" + name + "\"" +
                               advice(name, names_of_axes(axes)));
        (side == 0 ? draft.spec.axis_a : draft.spec.axis_b) = found->second;
    }
}

void read_ratio(CouplingDraft& draft, const Node& node) {
    draft.spec.ratio = Number{kRatio}.read(node);
    if (draft.spec.ratio == 0) node.fail("must not be 0, which would couple nothing");
}

CouplingSpec read_coupling(SceneDraft& scene, const Node& node, const std::string& name) {
    CouplingDraft draft{&scene, {}};
    draft.spec.name = name;
    read_object(draft, node, coupling_table());
    const Node joints = node.at("joints");
    if (!node.has("axes")) {
        draft.spec.axis_a = only_axis(draft, 0, joints);
        draft.spec.axis_b = only_axis(draft, 1, joints);
    }
    if (const std::optional<JointFault> fault = find_fault(draft.spec))
        node.at(fault->key).fail(fault->sentence);
    return std::move(draft.spec);
}

}  // namespace

const Table<CouplingDraft>& coupling_table() {
    using C = CouplingDraft;
    const SchemaJson two_names = {
        {"type", "array"}, {"items", Text{}.schema()}, {"minItems", 2}, {"maxItems", 2}};
    static const Table<C> table = {
        field<C>(
            "name", Text{}, [](C & c) -> auto& { return c.spec.name; }, "name in errors"),
        special<C>("joints", two_names, read_coupled_joints,
                   "names of two joints, whose coordinates are tied: second = ratio × first + "
                   "offset",
                   Presence::required),
        special<C>("axes", two_names, read_coupled_axes,
                   "axis of each joint; left out: the one that it is free in"),
        special<C>("ratio", Number{kRatio}.schema(), read_ratio,
                   "of the second coordinate to the first, not 0 [1], [m/rad], [rad/m]",
                   Presence::required),
        field<C>(
            "offset", Number{kCoordinate}, [](C & c) -> auto& { return c.spec.offset; },
            "[m], [rad]; left out: as the joints stand at the start"),
    };
    return table;
}

void add_coupling_definitions(SchemaJson& definitions) {
    definitions["coupling"] = object_schema(coupling_table());
}

void read_couplings(SceneDraft& draft, const Node& node) {
    if (!node.json().is_array()) node.fail_wanting("a list of couplings");
    Names names("coupling");
    auto& couplings = draft.scene.couplings;
    for (std::size_t i = 0; i < node.size(); ++i) {
        const Node entry = node.at(i);
        couplings.push_back(read_coupling(draft, entry, "coupling_" + std::to_string(i + 1)));
        names.add(couplings.back().name, static_cast<std::uint32_t>(i), entry);
    }
}

}  // namespace plumb::reader
