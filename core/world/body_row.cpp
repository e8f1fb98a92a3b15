// SPDX-License-Identifier: MIT
#include "world/body_row.h"

#include "geometry/mass_properties.h"
#include "math/principal.h"
#include "scene/error.h"

#include <cmath>
#include <cstdio>

namespace plumb {
namespace {

/// Radii of a body that gravity may move it by in one step. Beyond that, what a contact at a corner
/// takes from the fall turns the body several times within the step, and contacts, which are found
/// once a step, are of another side of it.
constexpr double kMostRadiiAStep = 25;

/// A body that is being made, and where it stands in the scene.
struct Draft {
    const Scene& assets;
    const BodySpec& spec;
    const std::string& pointer;

    [[noreturn]] void refuse(const char* key, const std::string& sentence) const {
        throw SceneError("", pointer + (*key ? std::string("/") + key : ""), sentence);
    }
};

struct BodyMass {
    double mass = 0;
    Vector3d moments = Vector3d::Zero();
    Placement body_in_geometry;  ///< centre of mass and principal axes
};

Placement mass_frame(const Draft& draft) {
    const Placement& frame = *draft.spec.mass_frame;
    if (!frame.position.allFinite() || !frame.rotation.coeffs().allFinite() ||
        frame.rotation.norm() < 1e-9)
        draft.refuse("mass_frame", "must be a point and a rotation");
    return {frame.position, frame.rotation.normalized()};
}

BodyMass body_mass(const Draft& draft) {
    const BodySpec& spec = draft.spec;
    BodyMass result;
    if (spec.geometry == kNoIndex) {
        if (!spec.mass || !spec.inertia)
            draft.refuse("", "a body without a shape needs both mass and inertia");
        result.mass = *spec.mass, result.moments = *spec.inertia;
        if (spec.mass_frame) result.body_in_geometry = mass_frame(draft);
        return result;
    }
    if (spec.mass_frame && !(spec.mass && spec.inertia))
        draft.refuse("mass_frame", "goes with both mass and inertia");
    const MassProperties m = mass_properties(draft.assets.geometries[spec.geometry]);
    if (!(m.volume > 0) && !(spec.mass && spec.inertia))
        draft.refuse("shape",
                     std::string("a ") + name_of(draft.assets.geometries[spec.geometry].kind) +
                         " that encloses no volume, or whose triangles are clockwise as seen from "
                         "outside, cannot be dynamic unless mass and inertia are given");
    result.mass = spec.mass.value_or(draft.assets.materials[spec.material].density * m.volume);
    result.body_in_geometry.position = m.centre;
    if (spec.mass_frame) {
        result.moments = *spec.inertia, result.body_in_geometry = mass_frame(draft);
    } else if (spec.inertia) {
        result.moments = *spec.inertia;
    } else {
        const Principal p = principal_axes(m.inertia * (result.mass / m.volume));
        result.moments = p.moments, result.body_in_geometry.rotation = p.axes;
    }
    return result;
}

void check_mass(const Draft& draft, const BodyMass& m) {
    if (!(m.mass > 0) || !std::isfinite(m.mass))
        draft.refuse("mass", "the mass of a dynamic body must be a positive number");
    const Vector3d& j = m.moments;
    if (!j.allFinite() || !(j.minCoeff() > 0))
        draft.refuse("inertia", "principal moments must be positive numbers");
    if (2 * j.maxCoeff() > j.sum() * (1 + 1e-6))
        draft.refuse(
            "inertia",
            "no body has such principal moments: each is at most the sum of the other two");
}

void check_spec(const Draft& draft) {
    const BodySpec& s = draft.spec;
    if (s.geometry != kNoIndex && s.geometry >= draft.assets.geometries.size())
        draft.refuse("shape", "no such shape");
    if (s.material >= draft.assets.materials.size()) draft.refuse("material", "no such material");
    if (!s.placement.position.allFinite()) draft.refuse("position", "must be finite numbers");
    if (!s.placement.rotation.coeffs().allFinite() || s.placement.rotation.norm() < 1e-9)
        draft.refuse("rotation", "must be a rotation");
    if (!s.velocity.allFinite() || !s.angular_velocity.allFinite())
        draft.refuse("velocity", "must be finite numbers");
    if (!s.force.allFinite() || !s.torque.allFinite())
        draft.refuse("force", "must be finite numbers");
}

/// Calls visit(column, value of the row) for all columns.
template <class Visit>
void each_column(Bodies& b, const BodyRow& row, Visit visit) {
    const bool dynamic = row.motion == Motion::dynamic;
    const double spread = row.inertia.maxCoeff() - row.inertia.minCoeff();
    visit(b.id, row.id), visit(b.motion, row.motion);
    visit(b.position, row.position), visit(b.orientation, row.orientation);
    visit(b.velocity, row.velocity), visit(b.angular_velocity, row.angular_velocity);
    visit(b.mass, row.mass), visit(b.inverse_mass, dynamic ? 1 / row.mass : 0);
    visit(b.inertia, row.inertia);
    visit(b.inverse_inertia,
          dynamic ? Vector3d(row.inertia.cwiseInverse()) : Vector3d(Vector3d::Zero()));
    visit(b.isotropic, std::uint8_t(!dynamic || spread <= 1e-9 * row.inertia.maxCoeff()));
    visit(b.force, row.force), visit(b.torque, row.torque);
    visit(b.geometry_in_body, row.geometry_in_body);
    visit(b.geometry, row.geometry), visit(b.bounding_radius, row.bounding_radius);
    visit(b.material, row.material), visit(b.group, row.group), visit(b.mask, row.mask);
    visit(b.script, row.script);
    visit(b.lost_to_ground, 0);
    visit(b.rest_time, 0), visit(b.sleeps_with, kNoIndex);
    visit(b.rest_way, Vector3d(Vector3d::Zero())), visit(b.rest_turn, Vector3d(Vector3d::Zero()));
    visit(b.row, 0);
    visit(b.world_inverse_inertia, Symmetric3<double>{});
    visit(b.angular_momentum, Vector3d(Vector3d::Zero()));
    visit(b.velocity_now, row.velocity), visit(b.velocity_before, row.velocity);
    visit(b.angular_velocity_now, row.angular_velocity);
    visit(b.angular_velocity_before, row.angular_velocity);
    visit(b.turn_change, Vector3d(Vector3d::Zero()));
}

void check_size(const Draft& draft, double radius) {
    const BodySpec& s = draft.spec;
    const Settings& settings = draft.assets.settings;
    const bool turns = draft.assets.geometries[s.geometry].kind != ShapeKind::sphere;
    if (s.motion != Motion::dynamic || !turns || s.mask == 0) return;
    const double g = settings.gravity.norm(), fall = g * settings.dt * settings.dt;
    if (fall <= kMostRadiiAStep * radius) return;
    char text[300];
    std::snprintf(text, sizeof text,
                  "the body reaches only %.2g m from its centre, and gravity moves it by %.2g m in "
                  "a step of %.2g s: the step may be %.2g s at most, or the body must reach %.2g m",
                  radius, fall, settings.dt, std::sqrt(kMostRadiiAStep * radius / g),
                  fall / kMostRadiiAStep);
    draft.refuse("shape", text);
}

}  // namespace

BodyRow make_body(const Scene& assets, const BodySpec& spec, const std::string& pointer) {
    const Draft draft{assets, spec, pointer};
    check_spec(draft);
    const bool has_shape = spec.geometry != kNoIndex;
    BodyMass m;
    if (spec.motion == Motion::dynamic) {
        m = body_mass(draft);
        check_mass(draft, m);
    }
    Placement start = spec.placement;
    start.rotation.normalize();
    const Placement body = start * m.body_in_geometry;

    BodyRow row;
    row.motion = spec.motion;
    row.position = body.position, row.orientation = body.rotation;
    if (spec.motion != Motion::fixed)
        row.velocity = spec.velocity, row.angular_velocity = spec.angular_velocity;
    row.mass = m.mass, row.inertia = m.moments;
    row.force = spec.force, row.torque = spec.torque;
    row.geometry_in_body = inverse(m.body_in_geometry);
    row.geometry = spec.geometry, row.material = spec.material;
    row.script = spec.script;
    if (!has_shape) return row;
    row.bounding_radius =
        bounding_radius(assets.geometries[spec.geometry], m.body_in_geometry.position);
    check_size(draft, row.bounding_radius);
    row.group = spec.group, row.mask = spec.mask;
    return row;
}

void resize_bodies(Bodies& bodies, std::size_t count) {
    each_column(bodies, BodyRow{},
                [&](auto& column, const auto& value) { column.resize(count, value); });
}

void put_body(Bodies& bodies, std::size_t slot, const BodyRow& row) {
    each_column(bodies, row, [&](auto& column, const auto& value) { column[slot] = value; });
}

}  // namespace plumb
