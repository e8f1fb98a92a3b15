// SPDX-License-Identifier: MIT
/// Solves the contacts and joints of one island until their laws hold, whatever its shape.
///
/// Sweeps leave an error that dies away the more slowly the taller a structure is: a tower of n
/// boxes bends by an error that takes n⁴ sweeps. Here all contacts are solved as one system. With
/// the impulses λ₀ of the substep before as a start, the change of the bodies' velocities minimises
///
///   ½ Δvᵀ M Δv + Σ γ/2m |λ(u)|²,    λ(u) = nearest point of the cone to λ₀ + m/γ (w − u),
///
/// which is convex and once differentiable: Newton's method with an exact line search, whose matrix
/// is made of 6 × 6 blocks on the graph of the island. γ is how soft a contact is against its
/// bodies. The next round starts from the impulses of this one, so that nothing is left of γ in the
/// end (the proximal point method), and corrects the normal velocity of what slides (de Saxcé's
/// shift). What may stand is first solved without that shift: if it sticks, it is right. Rows of
/// joints, with the force laws of what drives them, are terms of the same sum.
///
/// Sources: convex contact of Anitescu (2006) and Castro et al. (2022), proximal rounds after
/// Rockafellar (1976), the shift as a fixed point after Acary and Cadoux (2013).
#pragma once

#include "islands/island.h"
#include "islands/island_account.h"
#include "islands/island_effort.h"
#include "islands/island_newton.h"

#include <algorithm>
#include <vector>

namespace plumb {

struct IslandReport {
    std::uint32_t factorisations = 0;
    double residual = 0;   ///< greatest velocity by which the law of contact is missed [m/s]
    bool solved = true;    ///< whether that is little beside the speed of the island
    bool stirred = false;  ///< whether sweeps left more than what stays as it is
};

/// Reusable memory for islands of any size, one after another.
class IslandSolver {
public:
    /// Improves impulses and velocities until the law of contact holds. `system` has the pattern of
    /// the island's pairs; `speed` [m/s], at which its contacts would approach, is the measure of
    /// what may be missed. `settles`: whether to a finer tolerance (islands/island_effort.h).
    /// `most_products`: of blocks, what all factorisations may take.
    IslandReport solve(const Island& island, IslandSystem& system, double speed,
                       IslandEffort effort = IslandEffort::full, bool settles = false,
                       std::uint64_t most_products = kAnyProducts);

    /// Sweeps from the impulses and velocities that there are.
    void sweep(const Island& island);

    /// The same until the law of contact holds at its speed [m/s], and there and back no more than
    /// `most` times. Returns whether it does.
    bool sweep_until(const Island& island, double speed, int most);

    /// How the bodies are shifted apart over the substep, as velocities: sweeps from nothing and
    /// without friction, in which all contacts yield a little. `opening`: [point] on top of what is
    /// wanted of its velocity [m/s]; `shift`: 0 before.
    void open_apart(const Island& island, std::span<const double> opening,
                    std::span<Vector6d> shift);

    /// Takes all impulses away, and leaves the velocities.
    static void forget(const Island& island) {
        for (IslandPoint& p : island.points) p.impulse.setZero();
        for (TieRow& row : island.rows) row.impulse = 0;
    }

    /// Where nothing was found: sweeps from impulses of 0, which can make no more of it than there
    /// is. `ask()` comes before each.
    template <class Ask>
    void sweep_anew(const Island& island, Ask ask) {
        take(island);
        forget(island);
        for (int i = 0; i < kSweepsAnew; ++i) ask(), sweep_both_ways();
    }

    /// How the bodies are shifted over the substep to close ties, as velocities: sweeps from
    /// nothing, of which no impulse is left. `ask()` is about `moved`, the velocities with the
    /// shift.
    template <class Ask>
    void close_apart(const Island& island, std::span<Vector6d> moved, Ask ask) {
        keep_row_impulses(island);
        std::copy(island.velocity.begin(), island.velocity.end(), moved.begin());
        sweep_anew({island.bodies, moved, {}, island.rows}, ask);
        for (std::size_t k = 0; k < kept_row_impulse_.size(); ++k)
            island.rows[k].impulse = kept_row_impulse_[k];
    }

private:
    static constexpr int kSweepsAnew = 5;  ///< there and back

    void take(const Island& island);
    void keep_row_impulses(const Island& island);
    void keep_state();
    void restore_state();
    bool stands_or_slides(IslandReport& report, double speed);
    bool stands(IslandReport& report, double speed);
    void improve(IslandReport& report, double speed);
    void sweep_on(IslandReport& report, double enough);
    double most_shift() const;
    template <int N>
    [[gnu::flatten]] double residual_of_points() const;
    double residual() const;
    void take_back_impulses();
    double softness(double error, double hard) const;
    void sweep_both_ways();
    void sweep(bool forwards);
    template <int N>
    [[gnu::flatten]] void push(const IslandPoint& p, const ContactVector<N>& impulse);
    void push(TieRow& row, double impulse);
    template <int N>
    [[gnu::flatten]] void sweep(IslandPoint& p);
    void open(IslandPoint& p);
    template <int N>
    bool minimise(IslandNewton<N>& newton, double softness, double before, int steps,
                  std::uint32_t& factorisations);

    Island island_;
    bool turns_ = false;  ///< whether anything resists turning at a point
    IslandNewton<3> plain_;
    IslandNewton<6> turning_;
    IslandSystem* system_ = nullptr;
    double creep_ = 0;  ///< slip that is not shifted away [m/s]
    IslandEffort effort_ = IslandEffort::full;
    double enough_ = 0;  ///< up to which rounds go on [m/s]
    std::uint64_t most_factorisations_ = 0;
    bool shifts_ = true;                    ///< whether what slides is shifted (de Saxcé)
    std::vector<IslandPoint> apart_;        // [point] of open_apart
    std::vector<Vector6d> kept_velocity_;   // [body]
    std::vector<Vector6d> kept_impulse_;    // [point]
    std::vector<double> kept_row_impulse_;  // [row]
};

}  // namespace plumb
