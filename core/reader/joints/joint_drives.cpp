// SPDX-License-Identifier: MIT
#include "reader/joints/joint_drives.h"

#include <cmath>

namespace plumb::reader {

namespace {

using A = JointAxisSpec;
using M = JointMotor;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Range kFrequency{1e-6, 1e6}, kDampingRatio{0, 1e6};

/// [lower, upper], either of which may be null.
void read_limits(A& axis, const Node& node) {
    require_list(node, 2, "numbers or null");
    const auto bound = [&](std::size_t i, double none) {
        return node.at(i).json().is_null() ? none : Number{kCoordinate}.read(node.at(i));
    };
    axis.lower = bound(0, -kInfinity);
    axis.upper = bound(1, kInfinity);
    if (std::isinf(axis.lower) && std::isinf(axis.upper))
        node.fail("at least one of the two limits must be a number");
}

SchemaJson limits_schema() {
    const SchemaJson bound = {{"anyOf", {Number{kCoordinate}.schema(), {{"type", "null"}}}}};
    return {{"type", "array"}, {"items", bound}, {"minItems", 2}, {"maxItems", 2}};
}

ValueKey read_key(const Node& node) {
    require_list(node, 2, "numbers, a time and a value");
    return {Number{kNotNegative}.read(node.at(0)), Number{kCoordinate}.read(node.at(1))};
}

std::vector<ValueKey> read_keys(const Node& node) {
    if (node.size() == 0) node.fail_wanting("a list of at least one [time, value]");
    std::vector<ValueKey> keys;
    for (std::size_t i = 0; i < node.size(); ++i) keys.push_back(read_key(node.at(i)));
    return keys;
}

/// A number, or what it is at certain times.
auto reads_target(MotorMode mode) {
    return [mode](M& motor, const Node& node) {
        if (motor.mode != MotorMode::none)
            node.fail("a motor has either \"velocity\" or \"position\", not both");
        motor.mode = mode;
        if (node.json().is_array()) {
            motor.keys = read_keys(node);
        } else if (node.json().is_number()) {
            motor.target = Number{kCoordinate}.read(node);
        } else {
            node.fail_wanting("a number or a list of [time, value]");
        }
    };
}

SchemaJson target_schema() {
    const SchemaJson key = {
        {"type", "array"},
        {"prefixItems", {Number{kNotNegative}.schema(), Number{kCoordinate}.schema()}},
        {"minItems", 2},
        {"maxItems", 2}};
    return {{"anyOf",
             {Number{kCoordinate}.schema(), {{"type", "array"}, {"items", key}, {"minItems", 1}}}}};
}

const Table<M>& motor_table() {
    const std::string keys = ", or [[time, value], ...]: linear between, held at both ends";
    static const Table<M> table = {
        special<M>("velocity", target_schema(), reads_target(MotorMode::velocity),
                   "speed to hold [m/s], [rad/s]" + keys),
        special<M>("position", target_schema(), reads_target(MotorMode::position),
                   "place to go to [m], [rad]" + keys),
        field<M>("max", Number{kStrength}, &M::greatest,
                 "greatest force [N] or torque [N m]; left out: any"),
        field<M>("frequency", Number{kFrequency}, &M::frequency,
                 "how fast it comes to its position [Hz]"),
        field<M>("damping_ratio", Number{kDampingRatio}, &M::damping_ratio,
                 "of its way to its position; 1: no overshoot"),
    };
    return table;
}

void read_motor(A& axis, const Node& node) {
    axis.motor = {};
    read_object(axis.motor, node, motor_table());
    if (axis.motor.mode == MotorMode::none)
        node.fail("a motor needs either \"velocity\" or \"position\"");
    for (const char* key : {"frequency", "damping_ratio"}) {
        if (axis.motor.mode == MotorMode::velocity && node.has(key))
            node.at(key).fail("this is for a motor with a \"position\" alone");
    }
}

const Table<A>& spring_table() {
    static const Table<A> table = {
        field<A>("stiffness", Number{kStrength}, &A::stiffness, "[N/m], [N m/rad]"),
        field<A>("rest", Number{kCoordinate}, &A::rest,
                 "where it is at ease [m], [rad]; left out: as the joint stands at the start"),
        field<A>("damping", Number{kStrength}, &A::damping, "[N s/m], [N m s/rad]"),
    };
    return table;
}

void read_spring(A& axis, const Node& node) {
    read_object(axis, node, spring_table());
    if (!(axis.stiffness > 0) && !(axis.damping > 0))
        node.fail("a spring needs a \"stiffness\" or a \"damping\" above 0");
}

}  // namespace

const Table<A>& joint_axis_table() {
    static const Table<A> table = {
        special<A>("limits", limits_schema(), read_limits,
                   "[lower, upper]: how far the first body may move [m] or turn [radians] against "
                   "the second, from 0 at the start; of a distance joint the distance; null: no "
                   "limit"),
        special<A>("motor", reference_to("motor"), read_motor, "drives the axis"),
        special<A>("spring", reference_to("spring"), read_spring,
                   "spring and damper, in metres or radians"),
        field<A>("friction", Number{kStrength}, &A::friction,
                 "greatest force [N] or torque [N m] of dry friction"),
        field<A>("max_speed", Number{kNotNegative}, &A::greatest_speed,
                 "greatest speed, to either side [m/s], [rad/s]; left out: any"),
    };
    return table;
}

void add_joint_axis_definitions(SchemaJson& definitions) {
    SchemaJson motor = object_schema(motor_table());
    motor["oneOf"] = {{{"required", {"velocity"}}}, {{"required", {"position"}}}};
    definitions["motor"] = motor;
    definitions["spring"] = object_schema(spring_table());
    definitions["joint_axis"] = object_schema(joint_axis_table());
}

}  // namespace plumb::reader
