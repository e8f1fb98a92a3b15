// SPDX-License-Identifier: MIT
#include "host/world_state.h"
#include "math/fnv1a.h"
#include "world/sleep.h"

#include <optional>

namespace plumb {
namespace {

/// Takes numbers, and lists of them, into the hash.
class Hash {
public:
    template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T> Hash& operator<<(const T& x) {
        hash_.add(&x, sizeof x);
        return *this;
    }
    Hash& operator<<(const std::string& text) {
        hash_.add(text.data(), text.size());
        return *this << text.size();
    }
    Hash& operator<<(const Vector3d& v) { return *this << v[0] << v[1] << v[2]; }
    Hash& operator<<(const Placement& p) {
        const Quaterniond& q = p.rotation;
        return *this << p.position << q.x() << q.y() << q.z() << q.w();
    }
    template <class T>
    Hash& operator<<(const std::optional<T>& x) {
        *this << x.has_value();
        return x ? *this << *x : *this;
    }
    template <class T, std::size_t N>
    Hash& operator<<(const std::array<T, N>& list) {
        for (const T& x : list) *this << x;
        return *this;
    }
    template <class T>
    Hash& operator<<(const std::vector<T>& list) {
        *this << list.size();
        for (const T& x : list) *this << x;
        return *this;
    }
    Hash& operator<<(const PerpendicularPair& p) { return *this << p.u << p.w; }
    Hash& operator<<(const SurfacePair& s) {
        return *this << s.friction << s.restitution << s.rolling_friction << s.spinning_friction;
    }
    Hash& operator<<(const GeometryPart& part) { return *this << part.geometry << part.local; }
    Hash& operator<<(const Geometry& g) {
        return *this << g.kind << g.half_extents << g.radius << g.half_height << g.vertices
                     << g.faces << g.triangles << g.heights << g.rows << g.columns << g.spacing_x
                     << g.spacing_z << g.parts;
    }
    Hash& operator<<(const WorldPoint& p) { return *this << p.particle << p.body << p.position; }

    std::uint64_t value() const { return hash_.value(); }

private:
    Fnv1a hash_;
};

void add_settings(Hash& hash, const Settings& s) {
    hash << s.gravity << s.wind << s.gusts << s.gust_period << s.air_density << s.dt << s.substeps
         << s.velocity_iterations << s.position_iterations << s.method << s.precision << s.contacts
         << s.margin << s.reuse_distance << s.stiffness << s.recovery_speed << s.collision_depth
         << s.anchor_stiffness << s.gyroscopic << s.leapfrog_start << s.joints << s.exact_islands
         << s.accuracy << s.sleep_speed << s.sleep_time << s.exact_deformables << s.multilevel
         << s.tree_parts << s.joint_tolerance << s.warm_start << s.alternate_sweeps << s.shared_push
         << s.shared_cone << s.require << s.forbid;
}

void add_bodies(Hash& hash, const World& world) {
    const Bodies& b = world.bodies;
    hash << world.slots.next().id << b.id << b.mass << b.inertia << b.geometry_in_body << b.geometry
         << b.material << b.group << b.mask;
    for (const Motion motion : b.motion) hash << awake(motion);
    for (const MotionScript& script : b.script) {
        hash << script.loop << script.keyframes.size();
        for (const Keyframe& key : script.keyframes) hash << key.time << key.placement;
    }
}

void add_joints(Hash& hash, const JointTable& table) {
    hash << table.next_id << table.next_coupling_id << table.joints.size() << table.drives.size()
         << table.couplings.size();
    for (const Joint& j : table.joints)
        hash << j.id << j.kind << j.a << j.b << j.frame_a << j.frame_b << j.locked << j.turns
             << j.length << j.compliance << j.angular_compliance << j.breaking_force
             << j.breaking_torque;
    for (const JointDrive& d : table.drives) {
        const JointAxisSpec& s = d.spec;
        hash << d.joint << d.axis << d.kind << s.lower << s.upper << s.motor.mode
             << s.motor.greatest << s.motor.frequency << s.motor.damping_ratio << s.stiffness
             << s.rest << s.damping << s.friction << s.greatest_speed;
    }
    for (const JointCoupling& c : table.couplings)
        hash << c.id << c.joint_a << c.joint_b << c.axis_a << c.axis_b << c.ratio << c.offset;
}

void add_particles(Hash& hash, const World& world) {
    const Particles& p = world.particles;
    hash << p.mass << p.inverse_mass << p.radius << p.material << p.deformable;
    for (const Deformable& d : world.deformables) {
        const DeformableSpec& s = d.at_start();
        hash << s.kind << s.points << s.segments << s.triangles << s.tetrahedra << s.thickness
             << s.elasticity.youngs_modulus << s.elasticity.poissons_ratio << s.elasticity.damping
             << s.elasticity.bending_stiffness << s.volume_ratio << s.pressure << s.drag
             << s.skin_drag << s.tearing_strain << s.group << s.mask;
    }
    hash << world.links.size();
    for (const Link& l : world.links)
        hash << l.a << l.b << l.joins << l.shortest << l.longest << l.compliance << l.damping;
}

}  // namespace

std::uint64_t foundation(const World& world, const std::vector<Geometry>& geometries) {
    Hash hash;
    add_settings(hash, world.settings);
    hash << geometries << world.material_count << world.surface_pairs;
    add_bodies(hash, world);
    add_joints(hash, world.joints);
    add_particles(hash, world);
    return hash.value();
}

}  // namespace plumb
