// SPDX-License-Identifier: MIT
/// "robots": URDF files, each at a place of the scene.
#include "reader/drafts.h"
#include "reader/robots/robot.h"

namespace plumb::reader {

namespace {

struct RobotDraft {
    SceneDraft* scene;
    std::string file;
    RobotOptions options;
};

enum class Meshes { required, optional };

constexpr Range kForce{0, 1e15};
constexpr Range kFrequency{1e-6, 1e6};

const Table<RobotMotor>& motor_table() {
    using M = RobotMotor;
    static const Table<M> table = {
        field<M>("position", Number{kCoordinate}, &M::target,
                 "what it drives the joint to, as the URDF counts [rad], [m]"),
        special<M>(
            "velocity", Number{kCoordinate}.schema(),
            [](M& m, const Node& node) {
                m.mode = MotorMode::velocity;
                m.target = Number{kCoordinate}.read(node);
            },
            "in place of position: how fast it drives the joint [rad/s], [m/s]"),
        field<M>("max", Number{kForce}, &M::greatest,
                 "greatest torque or force [N m], [N]; left out: the URDF's limit of effort"),
        field<M>("frequency", Number{kFrequency}, &M::frequency,
                 "with which the heavier side of the joint answers to a position, all other joints "
                 "stiff; 5 is the default [Hz]"),
        field<M>("damping_ratio", Number{kNotNegative}, &M::damping_ratio,
                 "of the same; 1, the default, does not overshoot"),
    };
    return table;
}

void read_positions(RobotDraft& draft, const Node& node) {
    if (!node.json().is_object()) node.fail_wanting("an object of positions by joint");
    for (const auto& item : node.json().items())
        draft.options.positions[item.key()] = Number{kCoordinate}.read(node.at(item.key()));
}

void read_motors(RobotDraft& draft, const Node& node) {
    if (!node.json().is_object()) node.fail_wanting("an object of motors by joint");
    for (const auto& item : node.json().items()) {
        const Node motor = node.at(item.key());
        read_object(draft.options.motors[item.key()], motor, motor_table());
        motor.require_one("position", "velocity");
    }
}

const Table<RobotDraft>& robot_table() {
    using R = RobotDraft;
    static const Table<R> table = {
        field<R>("urdf", Text{}, &R::file, "URDF file, relative to the scene's folder",
                 Presence::required),
        field<R>(
            "name", Text{}, [](R & r) -> auto& { return r.options.name; },
            "NAME/LINK is then a body, NAME/JOINT a joint; left out: the URDF's own"),
        field<R>(
            "position", Vector3{kCoordinate},
            [](R & r) -> auto& { return r.options.placement.position; }, "of the root link [m]"),
        field<R>(
            "rotation", Rotation{}, [](R & r) -> auto& { return r.options.placement.rotation; },
            "of the root link; left out, its z axis points along y"),
        field<R>(
            "base", Choice<RobotBase>{{{"fixed", RobotBase::fixed}, {"free", RobotBase::free}}},
            [](R & r) -> auto& { return r.options.base; },
            "fixed, or free: moved by forces; left out: free if the root link has a mass"),
        special<R>(
            "material", Text{}.schema(),
            [](R& r, const Node& n) { r.options.material = r.scene->materials.find(n); },
            "name of a material, of all links"),
        special<R>(
            "meshes",
            Choice<Meshes>{{{"required", Meshes::required}, {"optional", Meshes::optional}}}
                .schema(),
            [](R& r, const Node& n) {
                r.options.meshes_required =
                    Choice<Meshes>{{{"required", Meshes::required}, {"optional", Meshes::optional}}}
                        .read(n) == Meshes::required;
            },
            "required (the default), or optional: collision meshes that cannot be had are left "
            "out"),
        field<R>(
            "decompose", Flag{}, [](R & r) -> auto& { return r.options.decompose; },
            "turn each mesh, which must be closed, into several convex hulls instead of one"),
        field<R>(
            "self_collision", Flag{}, [](R & r) -> auto& { return r.options.self_collision; },
            "whether its links collide with each other, but for those that a joint ties or that "
            "overlap at the start; true is the default"),
        special<R>("joints",
                   {{"type", "object"}, {"additionalProperties", Number{kCoordinate}.schema()}},
                   read_positions,
                   "where joints are at the start, by name, as the URDF counts [rad], [m]; left "
                   "out: 0, or the limit nearest to it"),
        special<R>("motors", names_of("robot_motor"), read_motors, "motors by joint"),
        field<R>(
            "hold", Flag{}, [](R & r) -> auto& { return r.options.hold; },
            "hold every joint that has no motor where it starts, as strongly as the URDF's limit "
            "of effort lets it"),
    };
    return table;
}

void read_robot(SceneDraft& draft, const Node& node) {
    RobotDraft robot{&draft, {}, {}};
    read_object(robot, node, robot_table());
    Robot added;
    try {
        added = add_robot(draft.scene, node.source().folder / robot.file, robot.options);
    } catch (const SceneError& error) {
        node.at("urdf").fail(error.what());
    }
    if (draft.scene.bodies.size() > kMaxBodies)
        node.fail("a scene may have at most " + std::to_string(kMaxBodies) + " bodies");
    for (const auto& [name, index] : added.links) draft.bodies.add(name, index, node);
    for (const auto& [name, index] : added.joints) draft.joints.add(name, index, node);
}

}  // namespace

void read_robots(SceneDraft& draft, const Node& node) {
    if (!node.json().is_array()) node.fail_wanting("a list of robots");
    for (std::size_t i = 0; i < node.size(); ++i) read_robot(draft, node.at(i));
}

void add_robot_definitions(SchemaJson& definitions) {
    definitions["robot_motor"] = object_schema(motor_table());
    definitions["robot_motor"]["oneOf"] = {{{"required", {"position"}}},
                                           {{"required", {"velocity"}}}};
    definitions["robot"] = object_schema(robot_table());
}

}  // namespace plumb::reader
