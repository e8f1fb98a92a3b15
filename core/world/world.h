// SPDX-License-Identifier: MIT
/// The world: all that a step reads and changes, as tables.
#pragma once

#include "scene/scene.h"
#include "world/bodies.h"
#include "world/contacts.h"
#include "world/elastic_impulses.h"
#include "world/joints.h"
#include "world/kept_factors.h"
#include "world/links.h"
#include "world/particle_contacts.h"
#include "world/particles.h"
#include "world/shape_store.h"
#include "world/slot_map.h"
#include "world/surface_contacts.h"

#include <cstdint>
#include <vector>

namespace plumb {

/// How two materials meet.
struct SurfacePair {
    double friction, restitution, rolling_friction, spinning_friction;
};

/// Two bodies as one number that sorts as (a, b) does; a < b.
constexpr std::uint64_t pair_key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t(a) << 32 | b;
}

struct World {
    Settings settings;
    Bodies bodies;
    SlotMap slots;  ///< of the bodies in their table, by Bodies::id
    JointTable joints;
    Particles particles;
    std::vector<Deformable> deformables;
    std::vector<Link> links;
    std::vector<SurfacePair> surface_pairs;  ///< [material_a × material_count + material_b]
    std::uint32_t material_count = 1;
    std::vector<std::uint64_t> excluded;  ///< pair_key of bodies that never collide, sorted; as
                                          ///< often as there are reasons
    ContactTable contacts;
    SleepingContacts asleep;  ///< of bodies of which none moves
    ParticleContactTable particle_contacts;
    std::vector<SurfaceContact> surface_contacts;
    std::vector<ElasticImpulse> elastic_impulses;  ///< sorted
    KeptFactors kept_factors;                      ///< of deformables as one system
    ShapeStore shapes;
    std::int32_t dynamic_count = 0;    ///< rows of dynamic bodies come first in the velocity table,
    std::int32_t kinematic_count = 0;  ///< then particles, kinematic bodies, and one row of zeros
    std::vector<std::uint32_t> body_of_row;  ///< [row of a dynamic body]
    double time = 0;                         ///< [s]
    std::uint64_t steps = 0;

    const SurfacePair& surface_pair(std::uint32_t body_a, std::uint32_t body_b) const {
        return surface_of(bodies.material[body_a], bodies.material[body_b]);
    }
    const SurfacePair& surface_of(std::uint32_t material_a, std::uint32_t material_b) const {
        return surface_pairs[material_a * material_count + material_b];
    }
    std::int32_t particle_row(std::size_t particle) const {
        return dynamic_count + static_cast<std::int32_t>(particle);
    }
    /// Rows that change: of dynamic bodies and of particles.
    std::int32_t moving_count() const { return particle_row(particles.size()); }
    /// Calls visit(body) for each body that a particle touches or is linked to, as often as one is.
    template <class Visit>
    void each_body_among_particles(Visit visit) const {
        for (const Contact& c : particle_contacts.found) visit(c.b);
        for (const SurfaceContact& c : surface_contacts)
            if (c.point.body != kNoIndex) visit(c.point.body);
        each_linked_body(false, visit);
    }
    /// The same for each end of a link between bodies, or of one with particles.
    template <class Visit>
    void each_linked_body(bool between_bodies, Visit visit) const {
        for (const Link& link : links)
            for (const WorldPoint* p : {&link.a, &link.b})
                if (link.is_between_bodies() == between_bodies && p->body != kNoIndex)
                    visit(p->body);
    }
    /// Whether a joint holds anything: it is whole, and one of its bodies is awake.
    bool acts(const Joint& joint) const {
        const auto is_awake = [&](std::uint32_t body) {
            return body != kNoIndex && bodies.motion[body] == Motion::dynamic;
        };
        return !joint.broken && (is_awake(joint.a) || is_awake(joint.b));
    }
    std::int32_t zero_row() const { return moving_count() + kinematic_count; }
    /// Row of a body; kNoIndex stands for the world, which is fixed.
    std::int32_t row_of(std::uint32_t body) const {
        return body == kNoIndex ? zero_row() : bodies.row[body];
    }
};

/// Acceleration by gravity and the constant force [m/s²].
inline double pull_on(const World& world, std::uint32_t body) {
    const Bodies& b = world.bodies;
    return (world.settings.gravity + b.force[body] * b.inverse_mass[body]).norm();
}

/// Makes the world of a scene. Throws SceneError, with a JSON pointer, for what cannot be
/// simulated: a dynamic body without mass, an impossible inertia, an index out of range, a number
/// that is not finite.
World build_world(const Scene& scene);

}  // namespace plumb
