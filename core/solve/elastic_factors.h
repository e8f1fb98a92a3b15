// SPDX-License-Identifier: MIT
/// The factors of the elastic system: second derivatives at some places, without what would make
/// them indefinite. They are kept from step to step while they lead on quickly; a saved state has
/// what they were made of, from which they are made again to the last bit.
#pragma once

#include "solve/elastic_parts.h"

#include <vector>

namespace plumb {

class ElasticFactors {
public:
    ElasticFactors(const World& world, const ElasticParts& parts);

    /// Once a step, of substeps of length h [s]: `begin_step` takes over what the step before left,
    /// if bodies are the same, and `store` leaves it for the next.
    void begin_step(const World& world, ElasticParts& parts, double h);
    void store(World& world);

    /// Whether there are any.
    bool exist() const { return exist_; }
    /// At x, to which a step led from `before`. Returns whether they exist then.
    bool make(ElasticParts& parts, const ParticlePlaces& x, const ParticlePlaces& before, double h);
    void drop();

    const KeptFactors& made_of() const { return made_of_; }

    /// Solves for b, [row of the system].
    void solve(std::vector<Vector3d>& b) { system_.solve(b); }

private:
    void order(const ElasticParts& parts);
    void take_near(const ElasticParts& parts);
    void reserve(const ElasticParts& parts);
    void attach_contacts(const ElasticParts& parts);
    void assemble_elements(const ElasticParts& parts, const ParticlePlaces& x,
                           const ParticlePlaces& before, double h);
    bool make_again(ElasticParts& parts, double h);

    SparseLdlt system_;
    bool exist_ = false;
    int made_ = 0;         // in this step
    KeptFactors made_of_;  // if they exist
    /// Of particles: first those of elements and links, then those that touch.
    std::vector<SparseLdlt::Pair> particle_pairs_;
    std::size_t own_pairs_ = 0;
    std::vector<SparseLdlt::Pair> near_, near_now_;  ///< those that touch, as they were ordered
    /// Of particles and attached rows, as told: first those of balloons, then those of contacts.
    std::vector<SparseLdlt::Pair> pairs_, contact_pairs_, pairs_now_;
    std::size_t balloon_pairs_ = 0;
    ParticlePlaces places_;  // memory of begin_step
};

}  // namespace plumb
