// SPDX-License-Identifier: MIT
/// Contacts of deformables, and of the bodies that touch them with each other, as part of the
/// elastic system.
///
/// Solved in turn with a stiff sheet, a contact of a heavy body never ends: the one lifts a light
/// point off, the other pulls it back. So bodies that touch sheets, with what lies on or beside
/// them, are unknowns of the system beside the particles, and a contact adds
///
///   Ψ = (|q_n|² + φ(q_t)) / 2ρ,  q = P(p − ρ u)
///
/// to what is minimised: the augmented Lagrangian of Coulomb's law (Alart and Curnier 1991).
///
///   u  velocity of one side's point, particles' or a body's, against the other's, with what the
///      gap leaves room for along n [m/s]
///   p  impulse on the first side as found so far [N s]; P makes its part along n push, and that
///      across n no greater than b = μ p_n
///   ρ  some times what the points resist a push with [kg], so that p is found in a few rounds
///   φ  q_t² where it sticks, 2 b |p_t − ρ u_t| − b² where it slides
///
/// With the friction that p_n allows, and not q_n, q follows from an energy (Haslinger 1983), or
/// Newton's method would go round in circles. Once p has been found, both are the same. Until then
/// there is friction, too, where a contact parts, or the energy would jump there.
#pragma once

#include "constraints/connector.h"
#include "effects/plan.h"
#include "math/disjoint_sets.h"
#include "math/sparse_ldlt.h"
#include "schedule/colouring.h"
#include "solve/elastic_ties.h"
#include "world/world.h"

#include <vector>

namespace plumb {

/// Whether the plan has an elastic system with contacts in it.
inline bool has_elastic_contacts(const Plan& plan) {
    return plan.runs(Effect::exact_deformables) &&
           (plan.runs(Effect::particle_contacts) || plan.runs(Effect::surface_contacts));
}

class ElasticContacts {
public:
    /// Of what a side's point moves by, in u, and of q on it.
    static constexpr double kSign[2] = {1, -1};

    /// A dynamic body of the system. Its velocities are rows of it.
    struct Body {
        std::uint32_t index = 0;                                 ///< in the world's table
        std::uint32_t row = 0;                                   ///< of v; that of ω comes next
        std::int32_t table_row = 0;                              ///< in the velocity table
        double mass = 0;                                         ///< [kg]
        double size = 0;                                         ///< radius of gyration [m]
        Matrix3d inertia = Matrix3d::Zero();                     ///< world frame [kg m²]
        InverseMass<double> inverse{0, {0, 0, 0, 0, 0, 0}};      ///< world frame
        Velocity<double> v{Vector3d::Zero(), Vector3d::Zero()};  ///< when the system is asked
    };
    /// How (force, torque) [N s], [N m s] change a body's velocity.
    static Velocity<double> change_by(const Body& body, const Vector6d& sum) {
        return {body.inverse.mass * sum.head<3>(), body.inverse.inertia * Vector3d(sum.tail<3>())};
    }
    /// What touches: a particle and a body, a triangle and a body or a particle, or two bodies.
    enum class Source : std::uint8_t { particle, surface, bodies };
    /// A side that is a body.
    struct Side {
        std::uint32_t index = kNoIndex;   ///< in the world's table; or it is of particles
        std::uint32_t body = kNoIndex;    ///< in `bodies`; or it does not yield
        Vector3d arm = Vector3d::Zero();  ///< from its centre [m]
    };
    struct Contact {
        Source of = Source::particle;
        std::uint32_t source = 0;  ///< in the world's table of these
        std::uint32_t points = 0;  ///< particles: 0, 1, 3 or 4
        std::uint32_t particle[4] = {0, 0, 0, 0};
        double weight[4] = {1, 0, 0, 0};  ///< of their velocities in u: negative on the second side
        Side sides[2];
        double friction = 0, rho = 0;
        Vector3d normal = Vector3d::Zero();  ///< towards the first side
        Vector3d given = Vector3d::Zero();   ///< part of u that nothing changes [m/s]
        /// As above; once `match` has corrected it, q is what both sides are given.
        Vector3d p = Vector3d::Zero(), q = Vector3d::Zero();
        bool slides = false;
        Vector3d u = Vector3d::Zero();        ///< of the last forces [m/s]
        Vector3d way = Vector3d::Zero();      ///< of u along the line that was begun [m/s]
        double held = 1;                      ///< q_t is this share of p_t − ρ u_t
        Vector3d applied = Vector3d::Zero();  ///< part of q that velocities have felt

        /// Of a triangle, and then another particle on the first side.
        bool is_between_particles() const { return points == 4; }
        double applied_along() const { return applied.dot(normal); }
        Vector3d applied_across() const { return applied - applied_along() * normal; }
    };

    explicit ElasticContacts(const Plan& plan);

    /// Once a step. Removes from `pairs` (of bodies) those that are solved here, and adds to `ties`
    /// what holds bodies of the system. Rows of bodies are numbered from `first_row` on.
    void load(const World& world, std::uint32_t first_row, std::vector<BodyPair>& pairs,
              ElasticTies& ties);

    bool empty() const { return contacts_.empty(); }
    std::uint32_t rows() const { return static_cast<std::uint32_t>(2 * bodies_.size()); }
    std::vector<Body>& bodies() { return bodies_; }
    const std::vector<Body>& bodies() const { return bodies_; }
    std::vector<Contact>& contacts() { return contacts_; }
    const std::vector<Contact>& contacts() const { return contacts_; }

    /// How the elements that are in the system resist a push on each particle [kg].
    void weigh(const SparseLdlt& system);

    /// Once a substep of length h [s]: gaps and arms. Of old overlap, `stiffness` is pushed out,
    /// and no more than `recovery` [m] of it counts.
    void begin(const World& world, double h, double stiffness, double recovery);

    /// Once a call of the system: velocities of bodies as they are, and without the system's
    /// impulses, [row of the system].
    void find_targets(std::vector<Vector3d>& v, std::vector<Vector3d>& target,
                      const ElasticTies& ties) const;

    /// (v, ω) of the bodies, out of [row of the system].
    void gather(const std::vector<Vector3d>& rows, std::vector<Vector6d>& of_bodies) const;
    void add_to_rows(const std::vector<Vector6d>& of_bodies, std::vector<Vector3d>& rows) const;

    /// Adds q to the forces on particles and bodies, [row of the system] times h [N s], and returns
    /// Ψ [J].
    double add_forces(const std::vector<Vector3d>& target, const std::vector<Vector3d>& v,
                      std::vector<Vector3d>& force);
    /// A line of velocities, from those of the last forces by `way` [row of the system], and how
    /// hard q pushes along it at a share of it [J].
    void begin_line(const std::vector<Vector3d>& way);
    double push_along(double share) const;
    /// Bodies, and −∂q/∂u of the last forces, into what factors are made of.
    void list_stiffness(KeptFactors& made_of) const;
    /// Whether these were made of the bodies that are here now.
    bool has_bodies_of(const KeptFactors& made_of) const;
    /// p ← q; returns the greatest |p − q| / ρ before [m/s].
    double take_forces();
    /// What contacts may give by themselves, about [J]: they get out of each other, bounce, and are
    /// of bodies that scripts move.
    double driven_energy() const;
    /// All p are 0 again; none push any more in this substep.
    void forget();
    void let_go();
    /// Once a step: what the next one begins from.
    void store(World& world) const;

private:
    void add_contacts_of_particles(const World& world);
    void add_linked_bodies(const World& world);
    void find_members(const World& world, const std::vector<BodyPair>& pairs,
                      const std::vector<Tie>& ties);
    bool is_member(const World& world, std::uint32_t body) const;
    void take_bodies(const World& world, std::vector<BodyPair>& pairs,
                     const std::vector<Tie>& ties);
    void take_ties(const World& world, const std::vector<Tie>& found, ElasticTies& ties);
    void add(const World& world, Contact& contact, std::uint32_t a, std::uint32_t b);
    std::uint32_t body_of(const World& world, std::uint32_t body);
    void take_kept(const World& world);
    void begin_bodies(const World& world, double h, Contact& contact) const;
    void find_force(const Vector3d& u, Contact& contact, double& energy) const;
    Vector3d velocity_of(const Contact& contact, const std::vector<Vector3d>& v) const;

    bool has_friction_, touches_;
    bool takes_bodies_;  ///< contacts of bodies with each other are solved here, too
    std::uint32_t first_row_ = 0;
    std::vector<Body> bodies_;
    std::vector<Contact> contacts_;
    std::vector<std::uint32_t> body_of_;   ///< [world's body] in `bodies_`
    DisjointSets groups_;                  ///< of the world's bodies
    std::vector<std::uint32_t> members_;   ///< [lowest of a group] how many it has
    std::vector<std::uint8_t> belongs_;    ///< [pair of bodies] whether it can be solved here
    std::vector<std::uint8_t> is_member_;  ///< [world's body] whether it belongs here
    std::vector<ElasticImpulse> keys_;     ///< of contacts of particles, sorted
    std::vector<const ElasticImpulse*> now_, before_;  ///< those without a match so far
    std::vector<double> resistance_;                   ///< [particle] [kg]
};

}  // namespace plumb
