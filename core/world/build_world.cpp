// SPDX-License-Identifier: MIT
/// From what the user wrote to the tables of the world.
#include "math/principal.h"
#include "scene/error.h"
#include "world/build_joints.h"
#include "world/mass_properties.h"
#include "world/world.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace plumb {
namespace {

[[noreturn]] void refuse(std::size_t body, const char* key, const std::string& sentence) {
    throw SceneError("", "/bodies/" + std::to_string(body) + (*key ? std::string("/") + key : ""),
                     sentence);
}

struct BodyMass {
    double mass = 0;
    Vector3d moments = Vector3d::Zero();
    Placement body_in_geometry;  ///< centre of mass and principal axes
};

Placement mass_frame(const Scene& scene, std::size_t i) {
    const Placement& frame = *scene.bodies[i].mass_frame;
    if (!frame.position.allFinite() || !frame.rotation.coeffs().allFinite() ||
        frame.rotation.norm() < 1e-9)
        refuse(i, "mass_frame", "must be a point and a rotation");
    return {frame.position, frame.rotation.normalized()};
}

BodyMass body_mass(const Scene& scene, std::size_t i) {
    const BodySpec& spec = scene.bodies[i];
    BodyMass result;
    if (spec.geometry == kNoIndex) {
        if (!spec.mass || !spec.inertia)
            refuse(i, "", "a body without a shape needs both mass and inertia");
        result.mass = *spec.mass, result.moments = *spec.inertia;
        if (spec.mass_frame) result.body_in_geometry = mass_frame(scene, i);
        return result;
    }
    if (spec.mass_frame && !(spec.mass && spec.inertia))
        refuse(i, "mass_frame", "goes with both mass and inertia");
    const MassProperties m = mass_properties(scene.geometries[spec.geometry]);
    if (!(m.volume > 0) && !(spec.mass && spec.inertia))
        refuse(i, "shape",
               std::string("a ") + name_of(scene.geometries[spec.geometry].kind) +
                   " that encloses no volume, or whose triangles are clockwise as seen from "
                   "outside, cannot be dynamic unless mass and inertia are given");
    result.mass = spec.mass.value_or(scene.materials[spec.material].density * m.volume);
    result.body_in_geometry.position = m.centre;
    if (spec.mass_frame) {
        result.moments = *spec.inertia, result.body_in_geometry = mass_frame(scene, i);
    } else if (spec.inertia) {
        result.moments = *spec.inertia;
    } else {
        const Principal p = principal_axes(m.inertia * (result.mass / m.volume));
        result.moments = p.moments, result.body_in_geometry.rotation = p.axes;
    }
    return result;
}

void check_mass(std::size_t i, const BodyMass& m) {
    if (!(m.mass > 0) || !std::isfinite(m.mass))
        refuse(i, "mass", "the mass of a dynamic body must be a positive number");
    const Vector3d& j = m.moments;
    if (!j.allFinite() || !(j.minCoeff() > 0))
        refuse(i, "inertia", "principal moments must be positive numbers");
    if (2 * j.maxCoeff() > j.sum() * (1 + 1e-6))
        refuse(i, "inertia",
               "no body has such principal moments: each is at most the sum of the other two");
}

void check_spec(const Scene& scene, std::size_t i) {
    const BodySpec& s = scene.bodies[i];
    if (s.geometry != kNoIndex && s.geometry >= scene.geometries.size())
        refuse(i, "shape", "no such shape");
    if (s.material >= scene.materials.size()) refuse(i, "material", "no such material");
    if (!s.placement.position.allFinite()) refuse(i, "position", "must be finite numbers");
    if (!s.placement.rotation.coeffs().allFinite() || s.placement.rotation.norm() < 1e-9)
        refuse(i, "rotation", "must be a rotation");
    if (!s.velocity.allFinite() || !s.angular_velocity.allFinite())
        refuse(i, "velocity", "must be finite numbers");
    if (!s.force.allFinite() || !s.torque.allFinite()) refuse(i, "force", "must be finite numbers");
}

void add_body(World& world, const Scene& scene, std::size_t i) {
    check_spec(scene, i);
    const BodySpec& spec = scene.bodies[i];
    Bodies& b = world.bodies;
    const bool dynamic = spec.motion == Motion::dynamic;
    BodyMass m;
    if (dynamic) {
        m = body_mass(scene, i);
        check_mass(i, m);
    }
    Placement start = spec.placement;
    start.rotation.normalize();
    const Placement body = start * m.body_in_geometry;

    b.motion.push_back(spec.motion);
    b.position.push_back(body.position);
    b.orientation.push_back(body.rotation);
    b.velocity.push_back(spec.motion == Motion::fixed ? Vector3d::Zero().eval() : spec.velocity);
    b.angular_velocity.push_back(spec.motion == Motion::fixed ? Vector3d::Zero().eval()
                                                              : spec.angular_velocity);
    b.mass.push_back(m.mass);
    b.inverse_mass.push_back(dynamic ? 1 / m.mass : 0);
    b.inertia.push_back(m.moments);
    b.inverse_inertia.push_back(dynamic ? m.moments.cwiseInverse().eval()
                                        : Vector3d::Zero().eval());
    b.isotropic.push_back(!dynamic || m.moments.maxCoeff() - m.moments.minCoeff() <=
                                          1e-9 * m.moments.maxCoeff());
    b.force.push_back(spec.force);
    b.torque.push_back(spec.torque);
    b.geometry_in_body.push_back(inverse(m.body_in_geometry));
    b.reach.push_back(spec.geometry == kNoIndex ? 0
                                                : reach_from(scene.geometries[spec.geometry],
                                                             m.body_in_geometry.position));
    b.material.push_back(spec.material);
    b.group.push_back(spec.geometry == kNoIndex ? 0 : spec.group);
    b.mask.push_back(spec.geometry == kNoIndex ? 0 : spec.mask);
    b.script.push_back(spec.script);
    b.world_inverse_inertia.push_back(Symmetric3<double>{});
    b.angular_momentum.push_back(Vector3d::Zero());
}

/// Dynamic bodies take the first rows, kinematic ones the next; all that is fixed shares the last.
void assign_rows(World& world) {
    Bodies& b = world.bodies;
    for (Motion m : b.motion) {
        world.dynamic_count += m == Motion::dynamic;
        world.kinematic_count += m == Motion::kinematic;
    }
    std::int32_t dynamic = 0, kinematic = world.dynamic_count;
    for (Motion m : b.motion)
        b.row.push_back(m == Motion::dynamic     ? dynamic++
                        : m == Motion::kinematic ? kinematic++
                                                 : world.zero_row());
}

void add_surface_pairs(World& world, const Scene& scene) {
    const auto n = static_cast<std::uint32_t>(scene.materials.size());
    world.material_count = n;
    world.surface_pairs.resize(std::size_t(n) * n);
    for (std::uint32_t a = 0; a < n; ++a)
        for (std::uint32_t b = 0; b < n; ++b) {
            const Material &x = scene.materials[a], &y = scene.materials[b];
            world.surface_pairs[a * n + b] = {std::sqrt(x.friction * y.friction),
                                              std::max(x.restitution, y.restitution),
                                              std::max(x.rolling_friction, y.rolling_friction),
                                              std::max(x.spinning_friction, y.spinning_friction)};
        }
    for (const MaterialPair& pair : scene.material_pairs)
        for (auto [a, b] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
            SurfacePair& s = world.surface_pairs.at(std::size_t(a) * n + b);
            s.friction = pair.friction.value_or(s.friction);
            s.restitution = pair.restitution.value_or(s.restitution);
            s.rolling_friction = pair.rolling_friction.value_or(s.rolling_friction);
            s.spinning_friction = pair.spinning_friction.value_or(s.spinning_friction);
        }
}

void keep_apart(World& world, const Scene& scene) {
    for (std::size_t i = 0; i < scene.apart.size(); ++i) {
        const auto [low, high] = std::minmax(scene.apart[i][0], scene.apart[i][1]);
        if (high >= world.bodies.size() || low == high)
            throw SceneError("", "/apart/" + std::to_string(i), "must be two different bodies");
        world.excluded.push_back(pair_key(low, high));
    }
}

}  // namespace

World build_world(const Scene& scene) {
    World world;
    world.settings = scene.settings;
    if (!(scene.settings.dt > 0) || !std::isfinite(scene.settings.dt))
        throw SceneError("", "/settings/dt", "the step must be a positive number of seconds");
    if (scene.settings.substeps == 0)
        throw SceneError("", "/settings/substeps", "at least one substep is needed");
    for (const Geometry& g : scene.geometries) world.shapes.add(g);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) add_body(world, scene, i);
    assign_rows(world);
    add_surface_pairs(world, scene);
    keep_apart(world, scene);
    build_joints(world, scene);
    return world;
}

}  // namespace plumb
