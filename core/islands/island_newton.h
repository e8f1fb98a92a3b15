// SPDX-License-Identifier: MIT
/// One round of an island's solution: the minimum of a convex function of its bodies' velocities
/// (islands/island_solver.h), by Newton's method with an exact line search.
#pragma once

#include "islands/island.h"
#include "islands/island_system.h"

#include <vector>

namespace plumb {

/// N: 6 numbers a point, or 3 where nothing resists turning. Reusable memory.
template <int N>
class IslandNewton {
public:
    /// From the impulses and velocities that there are. `softness`: γ; `error`: what the law of
    /// contact is missed by [m/s]; `shifts`: whether the wanted velocity of what slides faster than
    /// `creep` [m/s] is shifted (de Saxcé).
    [[gnu::flatten]] void begin(const Island& island, double softness, double error, bool shifts,
                                double creep);

    /// Newton's steps, until no body's momentum is off by more than `enough` of velocity [m/s].
    /// Returns whether that is found; `factorisations` counts on up to `most`.
    bool minimise(IslandSystem& system, double enough, int steps, std::uint32_t& factorisations,
                  std::uint64_t most);

    /// The impulses of the minimum, to the points and rows, by push(point or row, what is more).
    template <class Push>
    void take_impulses(Push push) const {
        for (std::size_t k = 0; k < work_.size(); ++k) {
            IslandPoint& p = island_.points[k];
            const PointWork& w = work_[k];
            const ContactVector<N> more = w.at.impulse - p.impulse.template head<N>();
            p.impulse.template head<N>() += more;
            push(p, more);
        }
        for (std::size_t k = 0; k < row_work_.size(); ++k) {
            TieRow& row = island_.rows[k];
            push(row, row_work_[k].answer(row_work_[k].rate).impulse - row.impulse);
        }
    }

private:
    struct PointWork {
        double stiffness;            ///< m/γ [kg]
        ContactVector<N> z;          ///< λ₀ + m/γ (w − u) at the velocities now
        ContactVector<N> direction;  ///< of u, along which the line is searched
        ContactVector<N> impulse;    ///< λ₀
        ContactCone cone;
        ConePoint<N> at;  ///< of the cone, nearest to z
    };
    /// Of a row, what a search along a line needs, side by side.
    struct RowWork {
        RowLaw law;        ///< with m/γ [kg], [kg m²]
        double rate;       ///< at the velocities now
        double direction;  ///< of the rate

        RowAnswer answer(double at_rate) const { return answer_of(law, at_rate); }
    };

    [[gnu::flatten]] double find_downhill();
    [[gnu::flatten]] void assemble(IslandSystem& system) const;
    [[gnu::flatten]] double slope(double step) const;
    double step_length(double decrease) const;

    Island island_;
    std::vector<PointWork> work_;        // [point]
    std::vector<RowWork> row_work_;      // [row]
    double momentum_ = 0, inertia_ = 0;  // of the change and of the direction, along the direction
    std::vector<Vector6d> change_, downhill_, direction_;  // [body]
};

extern template class IslandNewton<3>;
extern template class IslandNewton<6>;

}  // namespace plumb
