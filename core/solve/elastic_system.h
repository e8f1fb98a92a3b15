// SPDX-License-Identifier: MIT
/// What holds all deformables together, as one system.
///
/// With v̂ the velocities without its impulses, a substep of length h minimises
///
///   ½ (v − v̂)ᵀ M (v − v̂) + E(x + h v)
///
/// over the particles' velocities v: implicit Euler of the elastic energy E. Iterations over n rows
/// of elements take n² of them until the first row feels the last; Newton's method takes a few
/// steps, so that a sheet is as stiff as its data sheet says, however many particles it has and
/// whatever the iterations. Factors are kept while they lead on quickly: what is at rest takes no
/// new ones.
#pragma once

#include "math/anderson.h"
#include "solve/elastic_factors.h"
#include "solve/elastic_parts.h"
#include "solve/impulse_match.h"

#include <vector>

namespace plumb {

class ElasticSystem {
public:
    ElasticSystem(const World& world, const Plan& plan);

    /// Once a step, and after it; removes from `pairs` (of bodies) those that are solved here.
    void load(const World& world, std::vector<BodyPair>& pairs);
    /// After that, with those of all particles whose momentum is kept.
    void load_pieces(const FreePieces& pieces);
    void store(World& world);

    /// Once a substep, after it: impulses of ties, into the world's tables.
    void store_ties(World& world);

    /// Once a substep of length h [s], before any call of `solve`; overlap of contacts as of
    /// `ElasticContacts::begin`.
    void begin(const World& world, double h, double stiffness, double recovery);

    /// Improves the velocities of all particles [m/s], and of the contacts' bodies. What the system
    /// gave them in earlier calls of this substep is in them, and is weighed anew.
    void solve(std::vector<Vector3d>& velocity, const FreePieces& pieces);

    ElasticContacts& contacts() { return parts_.contacts; }
    const ElasticContacts& contacts() const { return parts_.contacts; }
    ElasticTies& ties() { return parts_.ties; }
    const ElasticTies& ties() const { return parts_.ties; }

private:
    /// How far a direction leads: the greatest velocity [m/s], and the root of twice the energy.
    struct Move {
        double greatest = 0, size = 0;
    };

    void size_rows();
    void find_elastic_forces();
    void find_forces();
    void sum_forces();
    Move find_direction();
    void advance(double step);
    double slope() const;
    double share_of_way();
    void search_line();
    void guess_rest();
    bool descend();
    double ask_ties();
    void go_rounds();
    bool has_moved(const std::vector<Vector3d>& velocity) const;
    bool gains_energy() const;
    double product(const std::vector<Vector3d>& x, const std::vector<Vector3d>& y) const;
    void keep_best();

    ElasticParts parts_;
    ElasticFactors factors_;
    ImpulseMatch match_;
    std::uint32_t rounds_ = 0;  ///< of a call, at the most
    double h_ = 0;
    double enough_ = 0, enough_size_ = 0;  ///< at the end, of a `Move`
    double near_ = 1;  ///< times as much in a round whose contacts' impulses are rough
    Vector3d fall_ = Vector3d::Zero();  ///< what gravity does in a substep [m/s]
    bool is_first_ = false;             ///< call of `solve` in this substep
    bool is_settled_ = false;           ///< the last call found the minimum

    ParticlePlaces start_, x_, before_step_;  ///< now, and before the step that led there
    std::vector<Vector3d> own_, elastic_;     ///< [particle] impulses [N s]; forces [N]
    /// [row of the system]: velocities and v̂ [m/s]; those of the least energy; those at the start
    /// of a call.
    std::vector<Vector3d> v_, target_, best_, begin_;
    std::vector<Vector3d> force_, direction_, way_, before_;  ///< [row of the system]
    std::vector<Vector6d> of_bodies_, on_bodies_;             ///< [body of the system] v; forces
    Anderson earlier_;                                        ///< steps with these factors
    double least_ = 0;                                        ///< that energy [J]
    double energy_ = 0;                                       ///< at the velocities now [J],
    double elastic_energy_ = 0, elastic_start_ = 0;           ///< its part E, and that at the start
};

}  // namespace plumb
