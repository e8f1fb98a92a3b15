// SPDX-License-Identifier: MIT
/// "bodies": single bodies; entries that stand for several are in repeat.cpp, chain.cpp and
/// mobile.cpp.
#include <algorithm>
#include <cstdio>
#include <iterator>

#include "reader/drafts.h"
#include "reader/repeat.h"

namespace plumb::reader {

namespace {

void read_shape(BodyDraft& draft, const Node& node) {
    SceneDraft& scene = *draft.scene;
    if (node.json().is_string()) {
        draft.spec.geometry = scene.shapes.find(node);
        return;
    }
    draft.spec.geometry = static_cast<std::uint32_t>(scene.scene.geometries.size());
    scene.scene.geometries.push_back(read_geometry(scene, node));
}

const Table<Keyframe>& keyframe_table() {
    using K = Keyframe;
    static const Table<K> table = {
        field<K>("time", Number{kNotNegative}, &K::time, "[s]", Presence::required),
        field<K>(
            "position", Vector3{kCoordinate}, [](K & k) -> auto& { return k.placement.position; },
            "world frame [m]; left out: the body's own"),
        field<K>(
            "rotation", Rotation{}, [](K & k) -> auto& { return k.placement.rotation; },
            "left out: the body's own"),
    };
    return table;
}

/// The keyframes of a script; `draft` already has the body's own placement.
void read_keyframes(BodyDraft& draft, const Node& node) {
    if (!node.json().is_array() || node.size() == 0)
        node.fail_wanting("a list of at least one keyframe");
    auto& keyframes = draft.spec.script.keyframes;
    for (std::size_t i = 0; i < node.size(); ++i) {
        Keyframe keyframe{0, draft.spec.placement};
        read_object(keyframe, node.at(i), keyframe_table());
        if (!keyframes.empty() && keyframe.time <= keyframes.back().time) {
            node.at(i).at("time").fail("must be later than the keyframe before it");
        }
        keyframes.push_back(keyframe);
    }
}

const Table<BodyDraft>& script_table() {
    using B = BodyDraft;
    static const Table<B> table = {
        special<B>("keyframes", list_of("keyframe"), read_keyframes,
                   "where the body is at certain times, evenly moving between them",
                   Presence::required),
        field<B>(
            "loop", Flag{}, [](B & b) -> auto& { return b.spec.script.loop; },
            "begin again after the last keyframe"),
    };
    return table;
}

void read_script(BodyDraft& draft, const Node& node) {
    read_object(draft, node, script_table());
    if (draft.spec.script.loop && draft.spec.script.keyframes.size() < 2) {
        node.fail("a loop needs at least two keyframes");
    }
}

/// Principal moments of a real body: none is greater than the sum of the other two.
void check_inertia(const Eigen::Vector3d& inertia, const Node& node) {
    constexpr double rounding = 1e-9;
    if (2 * inertia.maxCoeff() > inertia.sum() * (1 + rounding)) {
        node.fail(
            "no body has these moments of inertia: none may be greater than the sum of the other "
            "two");
    }
}

void check_shape(const BodyDraft& draft, const Node& node) {
    const BodySpec& body = draft.spec;
    if (body.geometry == kNoIndex) {
        if (body.motion != Motion::dynamic) node.fail("\"shape\" is missing");
        if (!body.mass || !body.inertia)
            node.fail("\"shape\" is missing; without it, \"mass\" and \"inertia\" are needed");
        return;
    }
    const ShapeKind kind = draft.scene->scene.geometries[body.geometry].kind;
    const bool boundless = kind == ShapeKind::plane || kind == ShapeKind::height_field;
    if (boundless && body.motion == Motion::dynamic) {
        node.fail(std::string("a ") + name_of(kind) +
                  " has no mass, so it cannot be dynamic; add \"motion\": \"fixed\"");
    }
}

void check_motion(const BodySpec& body, const Node& node) {
    const bool moves = !body.velocity.isZero(0) || !body.angular_velocity.isZero(0);
    if (body.motion == Motion::fixed && moves) {
        node.fail("a fixed body has no velocity; it can be \"kinematic\" or \"dynamic\"");
    }
    const bool is_pushed = !body.force.isZero(0) || !body.torque.isZero(0);
    if (body.motion != Motion::dynamic && is_pushed) {
        node.fail("only a dynamic body feels a \"force\" or \"torque\"");
    }
    if (body.motion != Motion::kinematic && node.has("script")) {
        node.at("script").fail(
            "only a kinematic body follows a script; add \"motion\": \"kinematic\"");
    }
}

void check_body(const BodyDraft& draft, const Node& node) {
    if (draft.spec.inertia) check_inertia(*draft.spec.inertia, node.at("inertia"));
    check_shape(draft, node);
    check_motion(draft.spec, node);
}

Field<BodyDraft> weight_field() {
    return field<BodyDraft>("weight", Number{kWeight}, &BodyDraft::weight,
                            "share of this body among those that a repeat deals");
}

const Table<BodyDraft>& prototype_table() {
    static const Table<BodyDraft> table = [] {
        Table<BodyDraft> fields = body_table();
        fields.push_back(weight_field());
        return fields;
    }();
    return table;
}

/// An entry that stands for several bodies, by the key that it has.
struct Several {
    const char* key;
    void (*read)(SceneDraft&, const Node&);
    const char* definition;
};
constexpr Several kSeveral[] = {{"repeat", read_repeat, "repeat"},
                                {"chain", read_chain, "chain_entry"},
                                {"mobile", read_mobile, "mobile_entry"}};

const Several* find_several(const Node& entry) {
    const auto* found = std::find_if(std::begin(kSeveral), std::end(kSeveral),
                                     [&](const Several& s) { return entry.has(s.key); });
    return found == std::end(kSeveral) ? nullptr : found;
}

/// Bodies without a name get "body_0001" by their place in the scene.
void name_the_rest(SceneDraft& draft) {
    auto& bodies = draft.scene.bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!bodies[i].name.empty()) continue;
        char text[32];
        std::snprintf(text, sizeof text, "body_%04zu", i + 1);
        std::string name = text;
        while (draft.bodies.has(name)) name += "_";
        bodies[i].name = name;
    }
}

}  // namespace

const Table<BodyDraft>& body_table() {
    using B = BodyDraft;
    using Bits = Whole<std::uint32_t>;
    constexpr Range bits{0, 4294967295.0};
    static const Table<B> table = {
        field<B>(
            "name", Text{}, [](B & b) -> auto& { return b.spec.name; },
            "name for joints and errors"),
        field<B>(
            "motion",
            Choice<Motion>{{{"dynamic", Motion::dynamic},
                            {"fixed", Motion::fixed},
                            {"kinematic", Motion::kinematic}}},
            [](B & b) -> auto& { return b.spec.motion; },
            "dynamic (the default), fixed, or kinematic: moved by its script or velocities alone"),
        special<B>("shape", reference_to("shape_or_name"), read_shape,
                   "a shape, or the name of one"),
        special<B>(
            "material", Text{}.schema(),
            [](B& b, const Node& n) { b.spec.material = b.scene->materials.find(n); },
            "name of a material"),
        field<B>(
            "position", Vector3{kCoordinate},
            [](B & b) -> auto& { return b.spec.placement.position; },
            "of the shape's frame at the start [m]"),
        field<B>(
            "rotation", Rotation{}, [](B & b) -> auto& { return b.spec.placement.rotation; },
            "of the shape's frame at the start"),
        field<B>(
            "velocity", Vector3{kCoordinate}, [](B & b) -> auto& { return b.spec.velocity; },
            "of the centre of mass [m/s]"),
        field<B>(
            "angular_velocity", Vector3{kCoordinate},
            [](B & b) -> auto& { return b.spec.angular_velocity; }, "[rad/s]"),
        field<B>(
            "mass", Number{kMass}, [](B & b) -> auto& { return b.spec.mass; },
            "[kg]; left out: density × volume"),
        field<B>(
            "inertia", Vector3{kMass}, [](B & b) -> auto& { return b.spec.inertia; },
            "principal moments about the axes of the shape's frame [kg m²]; left out: from the "
            "shape"),
        field<B>(
            "force", Vector3{kCoordinate}, [](B & b) -> auto& { return b.spec.force; },
            "constant, at the centre of mass [N]"),
        field<B>(
            "torque", Vector3{kCoordinate}, [](B & b) -> auto& { return b.spec.torque; },
            "constant [N m]"),
        field<B>(
            "group", Bits{bits}, [](B & b) -> auto& { return b.spec.group; },
            "bits; a and b collide if group of a & mask of b, and group of b & mask of a"),
        field<B>(
            "mask", Bits{bits}, [](B & b) -> auto& { return b.spec.mask; }, "bits, see group"),
        field<B>(
            "color", Color{}, [](B & b) -> auto& { return b.spec.color; }, "\"#rrggbb\""),
        special<B>("script", reference_to("script"), read_script, "motion of a kinematic body"),
    };
    return table;
}

BodyDraft read_body(SceneDraft& draft, const Node& node, bool prototype) {
    BodyDraft body{&draft, {}};
    read_object(body, node, prototype ? prototype_table() : body_table());
    check_body(body, node);
    return body;
}

void add_body(SceneDraft& draft, BodySpec spec, const Node& node) {
    auto& bodies = draft.scene.bodies;
    if (bodies.size() >= kMaxBodies) {
        node.fail("a scene may have at most " + std::to_string(kMaxBodies) + " bodies");
    }
    if (!spec.name.empty())
        draft.bodies.add(spec.name, static_cast<std::uint32_t>(bodies.size()), node);
    bodies.push_back(std::move(spec));
}

void read_bodies(SceneDraft& draft, const Node& node) {
    if (!node.json().is_array()) node.fail_wanting("a list of bodies");
    for (std::size_t i = 0; i < node.size(); ++i) {
        const Node entry = node.at(i);
        const auto* several = find_several(entry);
        if (several)
            several->read(draft, entry);
        else
            add_body(draft, read_body(draft, entry, false).spec, entry);
    }
    name_the_rest(draft);
}

void add_body_definitions(SchemaJson& definitions) {
    definitions["keyframe"] = object_schema(keyframe_table());
    definitions["script"] = object_schema(script_table());
    definitions["body"] = object_schema(body_table());
    definitions["prototype"] = object_schema(prototype_table());
    SchemaJson entry = reference_to("body");
    for (const Several& several : kSeveral)
        entry = {{"if", {{"required", {several.key}}}},
                 {"then", reference_to(several.definition)},
                 {"else", entry}};
    definitions["body_entry"] = entry;
}

}  // namespace plumb::reader
