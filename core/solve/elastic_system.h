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
#include "solve/elements.h"

#include <memory>
#include <vector>

namespace plumb {

class ElasticSystem {
public:
    explicit ElasticSystem(const World& world);

    /// Once a step: the factors that the step before left, and after it those that it leaves.
    void load(const World& world);
    void store(Particles& particles) const;

    /// Once a substep of length h [s], before any call of `solve`.
    void begin(const World& world, double h);

    /// Improves the velocities of all particles [m/s]. What the system gave them in earlier calls
    /// of this substep is in them, and is weighed anew.
    void solve(std::vector<Vector3d>& velocity);

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
    void attach_balloons();
    double measure(Balloon& balloon) const;
    void find_forces();
    void assemble();
    void assemble_balloons();
    bool factor();
    Move find_direction();
    void advance(double step);
    void drop_factors();
    double slope() const;
    void search_line();
    void descend();

    std::uint32_t particles() const { return static_cast<std::uint32_t>(mass_.size()); }

    std::vector<std::unique_ptr<Elements>> elements_;
    std::vector<Balloon> balloons_;
    std::vector<double> mass_;  ///< [particle], 0 of what stays [kg]
    SparseLdlt system_;
    bool has_factors_ = false;
    double h_ = 0, enough_ = 0;

    ParticlePlaces start_, x_, factored_;
    std::vector<Vector3d> v_, target_, own_;         ///< [particle]; v̂ [m/s]; impulses [N s]
    std::vector<Vector3d> elastic_;                  ///< [particle] forces [N]
    std::vector<Vector3d> force_, direction_, way_;  ///< [row of the system]
    std::vector<Vector3d> best_;  ///< [particle] velocities of the least energy [m/s]
    double least_ = 0;            ///< that energy [J]
    double energy_ = 0;           ///< at the velocities now [J]
};

}  // namespace plumb
