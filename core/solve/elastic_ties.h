// SPDX-License-Identifier: MIT
/// Joints, links and couplings of bodies that touch sheets, and links with particles, as part of
/// the elastic system.
///
/// Where a doll lies on a sheet, its limbs are held by its joints and by the sheet. Solved in turn,
/// neither lets the other get anywhere: the doll's elbow turns past its limit while the sheet holds
/// its arm. So rows of ties (ties/tie_row.h) are terms of what the system minimises, as those of
/// its contacts are: augmented Lagrangians, with the impulses that have been found so far.
///
/// What they tie are the system's bodies and, behind these, the particles that are linked.
#pragma once

#include "solve/elastic_tie_choice.h"
#include "ties/tie_rows.h"
#include "world/kept_factors.h"

#include <span>
#include <utility>
#include <vector>

namespace plumb {

class ElasticTies {
public:
    explicit ElasticTies(const World& world);

    /// Particles that are linked, in order.
    const std::vector<std::uint32_t>& points() const { return points_; }
    /// The particle, or kNoIndex, that is tied at this place.
    std::uint32_t particle(std::uint32_t at) const {
        return at < bodies_ ? kNoIndex : points_[at - bodies_];
    }

    // once a step

    /// Those of the world that can be solved here, of bodies if it `takes_bodies`.
    const std::vector<Tie>& find(const World& world, bool takes_bodies) {
        return choice_.find(world, takes_bodies);
    }
    /// Forgets those of the step before; `bodies`: how many the system has.
    void clear(std::uint32_t bodies);
    /// `at`: its bodies in the order of `each_body`, among those of the system, or kImmovable.
    void add(const World& world, const Tie& tie, TiedBodies at);

    bool empty() const { return range_.empty(); }
    /// Marks those that were added.
    void mark(SolvedTies& solved) const;
    /// Calls visit(a, b) for pairs of bodies of the system, and points, that they hold together.
    template <class Visit>
    void each_pair(Visit visit) const {
        for (const auto& [a, b] : pairs_) visit(a, b);
    }

    // once a substep of length h [s]

    /// Rows at its start, with the impulses of the one before.
    void begin(const World& world, double h);

    // velocities (v, ω) of the system's bodies, then (v, 0) of the points

    /// Appends those of the points; adds the forces on them to their rows.
    void gather(const std::vector<Vector3d>& rows, std::vector<Vector6d>& of_bodies) const;
    void add_to_rows(const std::vector<Vector6d>& of_bodies, std::vector<Vector3d>& rows) const;

    /// Asks the rows to close what is open at the preview of the velocities. Returns by how much
    /// that changes what the worst is asked for [m/s].
    double ask(std::span<const Vector6d> velocity);

    /// Finds the impulses at these velocities, adds them to (force, torque) of the bodies [N s],
    /// [N m s], and returns what they contribute to the energy, about [J].
    double add_forces(std::span<const Vector6d> velocity, std::span<Vector6d> force);

    /// As of ElasticContacts.
    void begin_line(std::span<const Vector6d> way);
    double push_along(double share) const;
    void list_stiffness(KeptFactors& made_of) const;
    double take_forces();
    /// What ties can give by themselves, about [J]: drives do work, and what is open closes.
    double driven_energy() const { return driven_energy_; }
    /// How fast scripts move the points of joints and links [m/s].
    double scripted_speed() const { return rows_.scripted_speed(range_); }
    /// Whether the row's impulse can change: it is not at a bound.
    bool yields(std::size_t row) const { return slope_[row] != 0; }
    /// All λ₀ are 0 again; none but those of particles hold any more in this substep.
    void forget();
    void let_go() { holds_ = false; }

    /// The rows, whose impulses are λ₀, the answers at the last forces, and what velocities have
    /// felt of them.
    std::span<const TieRow> rows() const { return rows_.rows(); }
    std::vector<double>& impulses() { return impulse_; }
    const std::vector<double>& impulses() const { return impulse_; }
    std::vector<double>& applied() { return applied_; }
    const std::vector<double>& applied() const { return applied_; }

    /// Impulses of the substep that ends at these velocities, into the world's tables.
    void store(std::span<const Vector6d> velocity, World& world);

private:
    void find_driven_energy(const World& world, double h);

    std::uint32_t place_of(const World& world, const WorldPoint& point) const;
    bool is_of_particles(const TieRow& row) const;

    std::vector<std::uint32_t> points_;  ///< particles
    std::uint32_t bodies_ = 0;           ///< of the system
    ElasticTieChoice choice_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;  ///< of bodies and points
    std::vector<Vector6d> rest_;      ///< [body or point of the system] no velocity
    std::vector<std::uint8_t> tied_;  ///< [body or point of the system] whether any ties it
    TieRows rows_;
    TieRange range_;
    std::vector<RowLaw> laws_;                ///< [row]
    std::vector<double> impulse_;             ///< [row] λ at the last forces [N s], [N m s]
    std::vector<double> applied_;             ///< [row]
    std::vector<double> wanted_;              ///< [row] before it was asked again
    std::vector<double> rate_, way_, slope_;  ///< [row] at the last forces; of the line
    bool holds_ = true;
    double mass_ = 0, driven_energy_ = 0;
};

}  // namespace plumb
