// SPDX-License-Identifier: MIT
/// "joints".
#include <algorithm>
#include <cmath>
#include <sstream>

#include "reader/drafts.h"
#include "reader/frames.h"
#include "reader/joints/joint_drives.h"
#include "reader/joints/joint_kinds.h"
#include "scene/joint_faults.h"

namespace plumb::reader {

namespace {

constexpr Range kBreaking{1e-9, 1e15};

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

void read_locked(JointDraft& draft, const Node& node) {
    if (!node.json().is_array()) node.fail_wanting("a list of axes");
    const Choice<JointAxis> axis{joint_axes()};
    for (std::size_t i = 0; i < node.size(); ++i) {
        bool& locked = draft.spec.locked[axis.read(node.at(i))];
        if (locked) node.at(i).fail("this axis stands in the list twice; once is enough");
        locked = true;
    }
}

SchemaJson axes_schema() {
    SchemaJson names = names_of_axes(joint_axes());
    for (const NamedAxis& axis : traits_of(JointKind::cone_twist).axes) names.push_back(axis.first);
    SchemaJson schema = names_of("joint_axis");
    schema["propertyNames"] = {{"enum", names}};
    return schema;
}

/// {"turn_x": {"limits": …}, …}.
void read_axes(JointDraft& draft, const Node& node) {
    if (!node.json().is_object()) node.fail_wanting("an object of axes by name");
    const KindTraits& kind = traits_of(draft.spec.kind);
    const auto names = names_of_axes(kind.axes);
    for (const auto& item : node.json().items()) {
        const Node entry = node.at(item.key());
        const auto found = std::find(names.begin(), names.end(), item.key());
        if (found == names.end())
            entry.fail("a joint of type " + kind.name + " is not free in \"" + item.key() + "\"" +
                       advice(item.key(), names));
        const JointAxis axis = kind.axes[static_cast<std::size_t>(found - names.begin())].second;
        if (draft.spec.locked[axis])
            entry.fail("\"locked\" has \"" + item.key() + "\", so nothing can act there");
        read_object(draft.spec.axes[axis], entry, joint_axis_table());
    }
}

const Table<JointDraft>& placement_table() {
    using J = JointDraft;
    static const Table<J> table = {
        field<J>("anchor", Vector3{kCoordinate}, &J::anchor,
                 "origin of the joint's frame at the start, on both bodies [m]; may be left out "
                 "where no translation is locked: the first body's position"),
        field<J>(
            "anchor_b", Vector3{kCoordinate}, [](J & j) -> auto& { return j.spec.anchor_b; },
            "of a distance joint: its end on the second body; the anchor is the one on the first "
            "[m]"),
        field<J>("axis", Vector3{kCoordinate}, &J::axis,
                 "x axis of the joint's frame, of any length but 0"),
        field<J>("second_axis", Vector3{kCoordinate}, &J::second_axis,
                 "y axis, made perpendicular to axis; left out: any that is"),
        special<J>("locked",
                   {{"type", "array"},
                    {"items", Choice<JointAxis>{joint_axes()}.schema()},
                    {"uniqueItems", true}},
                   read_locked,
                   "of a six_axis joint: the axes along and about which it does not move"),
    };
    return table;
}

const Table<JointDraft>& strength_table() {
    using J = JointDraft;
    static const Table<J> table = {
        field<J>(
            "compliance", Number{kStrength}, [](J & j) -> auto& { return j.spec.compliance; },
            "of the locked translations [m/N]"),
        field<J>(
            "angular_compliance", Number{kStrength},
            [](J & j) -> auto& { return j.spec.angular_compliance; },
            "of the locked rotations [rad/(N m)]"),
        field<J>(
            "breaking_force", Number{kBreaking},
            [](J & j) -> auto& { return j.spec.breaking_force; },
            "force above which it breaks for good [N]"),
        field<J>(
            "breaking_torque", Number{kBreaking},
            [](J & j) -> auto& { return j.spec.breaking_torque; },
            "torque above which it breaks for good [N m]"),
        field<J>(
            "collide", Flag{}, [](J & j) -> auto& { return j.spec.collide; },
            "whether the linked bodies collide with each other"),
    };
    return table;
}

/// The keys of an axis, for the one that a hinge or a slider has.
Table<JointDraft> main_axis_table() {
    Table<JointDraft> table;
    for (const Field<JointAxisSpec>& f : joint_axis_table())
        table.push_back({f.key, f.meaning, f.schema, f.presence,
                         [read = f.read](JointDraft& j, const Node& n) { read(j.main, n); }});
    return table;
}

void check_keys(const JointDraft& draft, const Node& node) {
    const std::string& kind = traits_of(draft.spec.kind).name;
    const auto usable = usable_keys(draft.spec.kind);
    for (const auto& item : node.json().items()) {
        if (std::find(usable.begin(), usable.end(), item.key()) != usable.end()) continue;
        node.at(item.key())
            .fail("a joint of type " + kind + " cannot use \"" + item.key() + "\"" +
                  advice("", usable));
    }
    for (const std::string& key : required_keys(draft.spec.kind)) {
        if (!node.has(key))
            node.fail("\"" + key + "\" is missing, which a joint of type " + kind + " needs");
    }
}

void set_frame(JointDraft& draft, const Node& node) {
    const BodySpec& body = draft.scene->scene.bodies[draft.spec.body_a];
    draft.spec.anchor = draft.anchor.value_or(body.placement.position);
    if (draft.second_axis && !draft.axis)
        node.at("second_axis").fail("\"second_axis\" needs an \"axis\" beside it");
    if (!draft.axis) return;
    if (!has_direction(*draft.axis))
        node.at("axis").fail("the axis is zero, so it has no direction");
    const Eigen::Vector3d x = draft.axis->normalized();
    const Eigen::Vector3d y = draft.second_axis.value_or(any_across(x));
    if (!has_direction(y)) node.at("second_axis").fail("the axis is zero, so it has no direction");
    if (are_parallel(x, y)) node.at("second_axis").fail("is parallel to \"axis\"");
    draft.spec.frame = frame_of(x, y);
}

/// Puts what stands beside "type" on the axis that it belongs to.
void set_main_axis(JointDraft& draft, const Node& node) {
    const KindTraits& kind = traits_of(draft.spec.kind);
    if (!kind.has_main_axis) return;
    const auto& [name, axis] = kind.axes.front();
    const auto keys = keys_of(joint_axis_table());
    const bool beside = std::any_of(keys.begin(), keys.end(),
                                    [&](const std::string& key) { return node.has(key); });
    if (!beside) return;
    if (node.has("axes") && node.at("axes").has(name))
        node.at("axes").at(name).fail("what acts on \"" + name +
                                      "\" stands beside \"type\" too; it must be in one place");
    draft.spec.axes[axis] = draft.main;
}

/// The coordinate of a distance joint is the distance itself, so a spring's rest is not 0.
void set_distance(JointDraft& draft, const Node& node) {
    if (draft.spec.kind != JointKind::distance) return;
    JointAxisSpec& axis = draft.spec.axes[kAlongX];
    const double length = (draft.spec.anchor - *draft.spec.anchor_b).norm();
    const Node keys = node.has("axes") && node.at("axes").has("x") ? node.at("axes").at("x") : node;
    if (keys.has("spring") && !keys.at("spring").has("rest")) axis.rest = length;
    if (is_free(draft.spec, kAlongX)) return;
    for (const char* key : {"motor", "spring", "friction", "max_speed"}) {
        if (keys.has(key))
            keys.at(key).fail(
                "a distance with neither \"limits\" nor a spring's \"stiffness\" is a rod, along "
                "which nothing moves");
    }
    if (length < kShortestDirection)
        node.at("anchor_b").fail("a rod needs two anchors that are apart");
}

/// The part of a joint that a fault is about, as near as it can be told.
Node place_of(const JointFault& fault, const JointDraft& draft, const Node& joint) {
    Node place = joint;
    for (const auto& [name, axis] : traits_of(draft.spec.kind).axes)
        if (axis == fault.axis && joint.has("axes") && joint.at("axes").has(name))
            place = joint.at("axes").at(name);
    std::istringstream parts(fault.key);
    for (std::string part; std::getline(parts, part, '/');) {
        if (place.has(part))
            place = place.at(part);
        else if (place.json().is_array())
            place = place.at(std::stoul(part));
    }
    return place;
}

JointSpec read_joint(SceneDraft& scene, const Node& node, const std::string& name) {
    JointDraft draft{&scene, {}, {}, {}, {}, {}};
    draft.spec.name = name;
    read_object(draft, node, joint_table());
    check_keys(draft, node);
    set_frame(draft, node);
    set_main_axis(draft, node);
    set_distance(draft, node);
    if (const std::optional<JointFault> fault = find_fault(draft.spec))
        place_of(*fault, draft, node).fail(fault->sentence);
    return std::move(draft.spec);
}

}  // namespace

const Table<JointDraft>& joint_table() {
    using J = JointDraft;
    static const Table<J> table = [] {
        Table<J> fields = {
            field<J>(
                "name", Text{}, [](J & j) -> auto& { return j.spec.name; },
                "name for couplings, errors and recordings"),
            field<J>(
                "type", joint_kinds(), [](J & j) -> auto& { return j.spec.kind; },
                joint_kinds_in_words(), Presence::required),
            special<J>(
                "bodies",
                {{"type", "array"}, {"items", Text{}.schema()}, {"minItems", 1}, {"maxItems", 2}},
                read_linked_bodies, "names of the linked bodies; one alone is joined to the world",
                Presence::required),
        };
        const auto append = [&](const Table<J>& more) {
            fields.insert(fields.end(), more.begin(), more.end());
        };
        append(placement_table());
        append(main_axis_table());
        fields.push_back(special<J>("axes", axes_schema(), read_axes,
                                    "what acts along and about each axis that the joint leaves "
                                    "free: x y z along, turn_x turn_y turn_z about; of a "
                                    "cone_twist twist and swing"));
        append(strength_table());
        return fields;
    }();
    return table;
}

void add_joint_definitions(SchemaJson& definitions) {
    add_joint_axis_definitions(definitions);
    SchemaJson joint = object_schema(joint_table());
    joint["allOf"] = rules_of_kinds();
    definitions["joint"] = joint;
    add_coupling_definitions(definitions);
}

void add_joint(SceneDraft& draft, JointSpec spec, const Node& node) {
    auto& joints = draft.scene.joints;
    draft.joints.add(spec.name, static_cast<std::uint32_t>(joints.size()), node);
    joints.push_back(std::move(spec));
}

void read_joints(SceneDraft& draft, const Node& node) {
    if (!node.json().is_array()) node.fail_wanting("a list of joints");
    for (std::size_t i = 0; i < node.size(); ++i) {
        const Node entry = node.at(i);
        add_joint(draft, read_joint(draft, entry, "joint_" + std::to_string(i + 1)), entry);
    }
}

}  // namespace plumb::reader
