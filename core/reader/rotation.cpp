// SPDX-License-Identifier: MIT
/// The three ways to write a rotation.
#include <cmath>
#include <numbers>

#include "reader/drafts.h"
#include "reader/frames.h"

namespace plumb::reader {

namespace {

struct RotationDraft {
    std::optional<Eigen::Vector3d> axis;  // any length but 0
    std::optional<double> degrees;
    std::optional<Eigen::Vector4d> quaternion;     // x, y, z, w; any length but 0
    std::optional<Eigen::Vector3d> euler_degrees;  // about x, then y, then z of the outer frame
};

/// [x, y, z, w].
struct Vector4 {
    Eigen::Vector4d read(const Node& node) const {
        require_list(node, 4, "numbers x, y, z, w");
        const Number number{kCoordinate};
        return {number.read(node.at(0)), number.read(node.at(1)), number.read(node.at(2)),
                number.read(node.at(3))};
    }
    SchemaJson schema() const {
        return {{"type", "array"},
                {"items", Number{kCoordinate}.schema()},
                {"minItems", 4},
                {"maxItems", 4}};
    }
};

const Table<RotationDraft>& rotation_table() {
    using R = RotationDraft;
    static const Table<R> table = {
        field<R>("axis", Vector3{kCoordinate}, &R::axis, "axis of rotation, of any length but 0"),
        field<R>("degrees", Number{kCoordinate}, &R::degrees, "angle about the axis [degrees]"),
        field<R>("quaternion", Vector4{}, &R::quaternion,
                 "[x, y, z, w], of any length but 0, which is brought to 1"),
        field<R>("euler_degrees", Vector3{kCoordinate}, &R::euler_degrees,
                 "angles about the outer x, then y, then z axis [degrees]"),
    };
    return table;
}

Eigen::Quaterniond turn(double degrees, const Eigen::Vector3d& unit_axis) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, unit_axis));
}

Eigen::Quaterniond from_axis(const RotationDraft& draft, const Node& node) {
    if (!draft.axis || !draft.degrees) node.fail("\"axis\" and \"degrees\" go together");
    if (!has_direction(*draft.axis))
        node.at("axis").fail("the axis is zero, so it has no direction");
    return turn(*draft.degrees, draft.axis->normalized());
}

Eigen::Quaterniond from_quaternion(const Eigen::Vector4d& q, const Node& node) {
    if (q.norm() < kShortestDirection)
        node.at("quaternion").fail("the quaternion is zero, so it is no rotation");
    return Eigen::Quaterniond(q.normalized());
}

}  // namespace

Eigen::Quaterniond Rotation::read(const Node& node) const {
    RotationDraft draft;
    read_object(draft, node, rotation_table());

    const int ways = (draft.axis || draft.degrees) + draft.quaternion.has_value() +
                     draft.euler_degrees.has_value();
    if (ways != 1) {
        node.fail(
            "must be one of {\"axis\", \"degrees\"}, {\"quaternion\"} and {\"euler_degrees\"}");
    }
    if (draft.quaternion) return from_quaternion(*draft.quaternion, node);
    if (!draft.euler_degrees) return from_axis(draft, node);

    const Eigen::Vector3d& e = *draft.euler_degrees;
    return turn(e.z(), Eigen::Vector3d::UnitZ()) * turn(e.y(), Eigen::Vector3d::UnitY()) *
           turn(e.x(), Eigen::Vector3d::UnitX());
}

SchemaJson Rotation::schema() const { return reference_to("rotation"); }

SchemaJson rotation_definition() {
    SchemaJson json = object_schema(rotation_table());
    json["oneOf"] = {{{"required", {"axis", "degrees"}}},
                     {{"required", {"quaternion"}}},
                     {{"required", {"euler_degrees"}}}};
    return json;
}

}  // namespace plumb::reader
