// SPDX-License-Identifier: MIT
/// A scene that runs: the facade that programs use.
///
///     plumb::Scene scene = …;
///     plumb::ColliderLibrary colliders;
///     plumb::Simulation simulation(scene, colliders, "ode");
///     while (simulation.time() < 10) simulation.step();
///
/// To bring a collider of your own, derive from plumb::Proximity and use the other constructor.
///
/// Bodies, joints and couplings are named by identifiers: those of the scene by their index in it,
/// those added later by what `add_…` returns. An identifier is never used twice.
#pragma once

#include "effects/ledger.h"
#include "effects/plan.h"
#include "effects/report.h"
#include "host/body_contact.h"
#include "host/collider_library.h"
#include "measure/frame.h"
#include "scene/scene.h"
#include "ties/joint_state.h"
#include "world/world.h"

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

/// Where a shape that is cast meets a body first.
struct ShapeHit {
    std::uint32_t body;             ///< identifier
    std::uint32_t part;             ///< part of a compound, triangle of a mesh; else 0
    double distance;                ///< that the shape went [m]
    Eigen::Vector3d point, normal;  ///< of the body's surface, world frame [m], unit
};

class Simulation {
public:
    /// Runs on a collider of yours, which must outlive the simulation. Throws SceneError or
    /// ColliderError.
    Simulation(const Scene& scene, Proximity& proximity, std::string collider_name = "custom");

    /// Runs on a plugin by name; "auto" takes the cheapest that supports all pairs of the
    /// scene.
    Simulation(const Scene& scene, const ColliderLibrary& colliders, const std::string& collider);

    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;
    /// What was moved from can only be assigned to or destroyed.
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    /// Advances by Settings::dt.
    StepReport step();

    double time() const;          ///< [s]
    std::uint64_t steps() const;  ///< made so far
    const World& world() const;
    const Plan& plan() const;
    const Ledger& ledger() const;  ///< of the last step
    DetectStats detect_stats() const;

    /// How far the last step's end is from its constraints, each island that has some: what
    /// StepReport::residual tells of all. Stays until the next step or edit.
    const std::vector<IslandResidual>& island_residuals() const;

    const std::string& collider_name() const;
    const std::string& collider_version() const;
    const std::string& collider_reason() const;  ///< why "auto" took it; empty where it was named

    /// The bodies as they are, with the residual of the last step: NaN before the first, and in a
    /// state that was restored.
    void capture(Frame& frame) const;

    /// From the next step on, contacts and events are kept for the members below, until
    /// `stop_watching_contacts`. Nobody else pays for them, and nothing that a step does depends on
    /// them. All that touches in the first step that is watched begins to. May be called again, to
    /// change what a hit is.
    void watch_contacts(const ContactWatch& watch = {});
    void stop_watching_contacts();

    /// The contacts of the last step, sorted by (body_a, body_b): also those that bore nothing,
    /// since the step looked out for them. Of a pair the order of the points is the same in each
    /// run. The three are as they were at the end of the step, whatever was edited since, stay
    /// until the next, and throw std::logic_error where nothing is watched.
    const std::vector<BodyContact>& contacts() const;

    /// Those of particles, sorted by (particle, body).
    const std::vector<ParticleContact>& particle_contacts() const;

    /// Which pairs of bodies began to touch, hit each other and ended, sorted by (body_a, body_b)
    /// and in this order.
    const std::vector<ContactEvent>& contact_events() const;

    /// All that a step leaves for the next, as bytes: little-endian, with a version, a length and a
    /// checksum. A simulation that is restored goes on to the same bits on the same collider,
    /// however many threads and lanes it has.
    ///
    /// What a scene and edits make of a simulation is not in it. `restore` takes the bytes of this
    /// simulation, or of another one of the same scene with the same edits: bodies, joints and
    /// couplings of the same identifiers, placed, pushed and driven as may be. It throws
    /// std::invalid_argument, and changes nothing, for bytes that are not such a state or not of
    /// such a simulation; ColliderError where the collider refuses to let a pair meet or to keep it
    /// apart.
    std::string save() const;
    void restore(std::string_view bytes);

    /// The first body that a ray meets: from `origin` [m] along the unit vector `direction`, at
    /// most `length` [m]; bodies with (group & mask) != 0. Nothing where it meets none.
    ///
    /// This and the next three ask about where the bodies are now, also before the first step and
    /// after edits. The first question after a step or an edit tells the collider where all are,
    /// which costs a broad phase. They throw std::logic_error in scenes without contacts,
    /// std::invalid_argument for bad numbers, and ColliderError where the collider cannot answer.
    std::optional<RayHit> cast_ray(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                   double length = std::numeric_limits<double>::infinity(),
                                   std::uint32_t mask = ~0u);

    /// The first body that a geometry (as in `overlaps`) meets on its way from a placement along
    /// the unit vector `direction`, over a finite `length` [m], without turning. Nothing where it
    /// meets none; what it slides along it does not meet, and what it overlaps from the start it
    /// meets at 0. Costs a broad phase for each advance: a few, unless it passes close by what
    /// is curved.
    std::optional<ShapeHit> cast_shape(std::uint32_t geometry, const Placement& from,
                                       const Eigen::Vector3d& direction, double length,
                                       std::uint32_t mask = ~0u);

    /// The deepest or nearest contact of two bodies at any distance, whatever their filters; the
    /// body of the lower identifier is a, and the normal points from b to a. Throws
    /// std::out_of_range where there is no such body.
    Contact closest(std::uint32_t body_a, std::uint32_t body_b);

    /// The bodies that a geometry (of the scene, or of add_geometry) would touch or overlap if it
    /// stood there, by identifiers, sorted: those with (group & mask) != 0 that may touch anything.
    /// Costs two broad phases. Throws std::out_of_range where there is no such geometry.
    std::vector<std::uint32_t> overlaps(std::uint32_t geometry, const Placement& placement,
                                        std::uint32_t mask = ~0u);

    /// The identifier of the first body, joint, material or deformable of this name that there is.
    std::optional<std::uint32_t> find_body(const std::string& name) const;
    std::optional<std::uint32_t> find_joint(const std::string& name) const;
    std::optional<std::uint32_t> find_material(const std::string& name) const;
    std::optional<std::uint32_t> find_deformable(const std::string& name) const;

    /// Where a body's geometry is, and how fast its centre of mass moves and it turns.
    BodyState body_state(std::uint32_t body) const;

    /// Puts a body's geometry somewhere else, of whatever motion the body is unless it follows
    /// keyframes: a jump, over which it keeps its velocity and forgets what it touched.
    void set_placement(std::uint32_t body, const Placement& placement);

    /// Sets the velocity of the centre of mass [m/s] and the angular velocity [rad/s] of a body
    /// that is not fixed and follows no keyframes.
    void set_velocity(std::uint32_t body, const Eigen::Vector3d& velocity,
                      const Eigen::Vector3d& angular_velocity);

    /// Replaces the constant force [N] and torque [N m] on a dynamic body.
    void set_force(std::uint32_t body, const Eigen::Vector3d& force, const Eigen::Vector3d& torque);

    /// Where a joint stands along or about one of its free axes (JointAxis) [m], [rad], and how
    /// fast that changes [m/s], [rad/s]. This and the next three throw std::out_of_range where
    /// there is no such joint, std::invalid_argument where the axis is locked or has no motor.
    struct JointMotion {
        double position, velocity;
    };
    JointMotion joint_motion(std::uint32_t joint, std::uint32_t axis) const;

    /// Force at the joint's point of body a and torque on a, from b: the mean of the last two
    /// substeps.
    JointLoad joint_load(std::uint32_t joint) const;

    /// Whether a joint gave way to more than its breaking force or torque.
    bool is_broken(std::uint32_t joint) const;

    /// Replaces the target of a motor [m/s], [rad/s], or [m], [rad].
    void set_motor_target(std::uint32_t joint, std::uint32_t axis, double target);

    /// Edits, between two steps. All that they do not name goes on as it was: velocities, forces
    /// remembered by contacts and joints, broken joints, turns counted. An edited world steps
    /// exactly as one that was made so from the start would at the same state. Each throws what is
    /// said below and then leaves the world as it was; an identifier that was removed throws
    /// std::out_of_range. Many edits before a step cost one renewal of the plan and the solver.
    ///
    /// Recordings and other outputs take the bodies of a scene and refuse frames of others.

    /// For BodySpec::geometry. It stays as long as the simulation; bodies should share it. Throws
    /// SceneError for faces of corners that there are not.
    std::uint32_t add_geometry(const Geometry& geometry);

    /// For BodySpec::material; meets others by the rules of combination. Throws
    /// std::invalid_argument for negative or infinite numbers.
    std::uint32_t add_material(const Material& material);

    /// Adds a body at its placement. Throws SceneError for what cannot be simulated and
    /// ColliderError for a pair of shapes that the collider cannot do, with those that can.
    std::uint32_t add_body(const BodySpec& body);

    /// Takes a body away, with its joints and their couplings. Throws ColliderError where the
    /// collider refuses.
    void remove_body(std::uint32_t body);

    /// Adds a joint between bodies, given by their identifiers, as they stand: its coordinates are
    /// 0 there. Throws SceneError for what cannot be simulated.
    std::uint32_t add_joint(const JointSpec& joint);

    /// Takes a joint away, with its couplings; what it linked may collide again.
    void remove_joint(std::uint32_t joint);

    /// Ties two joints, given by their identifiers; without an offset, as they stand. Throws
    /// SceneError for what cannot be simulated.
    std::uint32_t add_coupling(const CouplingSpec& coupling);
    void remove_coupling(std::uint32_t coupling);

    bool has_body(std::uint32_t body) const;
    bool has_joint(std::uint32_t joint) const;

    /// The body's index in the tables of `world()` and in Frame::bodies, as long as it lives;
    /// Bodies::id and Frame::ids tell the way back.
    std::uint32_t slot_of(std::uint32_t body) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace plumb
