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

#include "constraints/volume.h"
#include "math/anderson.h"
#include "solve/elastic_contacts.h"
#include "solve/elements.h"

#include <memory>
#include <vector>

namespace plumb {

class ElasticSystem {
public:
    ElasticSystem(const World& world, const Plan& plan);

    /// Once a step: the factors that the step before left, of the same bodies, and after it those
    /// that it leaves.
    /// Removes from `pairs` (of bodies) those that are solved here.
    void load(const World& world, std::vector<BodyPair>& pairs);
    void store(World& world);

    /// Once a substep of length h [s], before any call of `solve`; overlap of contacts as of
    /// `ElasticContacts::begin`.
    void begin(const World& world, double h, double stiffness, double recovery);

    /// Improves the velocities of all particles [m/s], and of the contacts' bodies. What the system
    /// gave them in earlier calls of this substep is in them, and is weighed anew.
    void solve(std::vector<Vector3d>& velocity);

    ElasticContacts& contacts() { return contacts_; }
    const ElasticContacts& contacts() const { return contacts_; }

private:
    struct Balloon {
        const Triangles* triangles;
        std::uint32_t first, count;      ///< particles
        double volume;                   ///< to be kept [m³]
        double pressure;                 ///< given [Pa]
        double stiffness;                ///< of a kept volume [Pa/m³]
        std::vector<Vector3d> gradient;  ///< of the volume at the places now [m²]

        bool keeps_volume() const { return stiffness > 0; }
    };
    /// How far a direction leads: the greatest velocity [m/s], and the root of twice the energy.
    struct Move {
        double greatest = 0, size = 0;
    };

    void make_balloons(const World& world);
    void number_balloons();
    void size_rows();
    void attach_contacts();
    double measure(Balloon& balloon) const;
    void find_elastic_forces();
    void find_forces();
    void sum_forces();
    void assemble_elements();
    void assemble_balloons();
    bool factor();
    bool factor_as_made();
    Move find_direction();
    void advance(double step);
    void drop_factors();
    double slope() const;
    double share_of_way();
    void search_line();
    void guess_rest();
    bool descend();
    void go_rounds();
    bool has_moved(const std::vector<Vector3d>& velocity) const;
    bool gains_energy() const;
    double product(const std::vector<Vector3d>& x, const std::vector<Vector3d>& y) const;
    void keep_best();

    std::uint32_t first_body_row() const { return particles() + balloon_rows_; }
    std::uint32_t particles() const { return static_cast<std::uint32_t>(mass_.size()); }

    std::vector<std::unique_ptr<Elements>> elements_;
    std::vector<Balloon> balloons_;
    std::vector<double> mass_;  ///< [particle], 0 of what stays [kg]
    ElasticContacts contacts_;
    bool has_contacts_;
    std::uint32_t rounds_ = 0;  ///< of a call, at the most
    /// Of particles and attached rows, as told: first those of balloons, then those of contacts.
    std::vector<SparseLdlt::Pair> pairs_, contact_pairs_, pairs_now_;
    std::uint32_t balloon_rows_ = 0;
    std::size_t balloon_pairs_ = 0;
    SparseLdlt system_;
    bool has_factors_ = false;
    int new_factors_ = 0;  ///< in this step
    double h_ = 0;
    double enough_ = 0, enough_size_ = 0;  ///< at the end, of a `Move`
    double near_ = 1;  ///< times as much in a round whose contacts' impulses are rough
    Vector3d fall_ = Vector3d::Zero();  ///< what gravity does in a substep [m/s]
    bool is_first_ = false;             ///< call of `solve` in this substep
    bool is_settled_ = false;           ///< the last call found the minimum

    ParticlePlaces start_, x_, before_step_;  ///< now, and before the step that led there
    KeptFactors made_of_;                     ///< the factors
    std::vector<Vector3d> own_, elastic_;     ///< [particle] impulses [N s]; forces [N]
    /// [row of the system]: velocities and v̂ [m/s]; those of the least energy; those at the start
    /// of a call.
    std::vector<Vector3d> v_, target_, best_, begin_;
    std::vector<Vector3d> force_, direction_, way_, before_;  ///< [row of the system]
    Anderson earlier_;                                        ///< steps with these factors
    double least_ = 0;                                        ///< that energy [J]
    double energy_ = 0;                                       ///< at the velocities now [J],
    double elastic_energy_ = 0, elastic_start_ = 0;           ///< its part E, and that at the start
};

}  // namespace plumb
