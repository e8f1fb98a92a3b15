// SPDX-License-Identifier: MIT
/// Couplings (ties/coupling_row.h) by iterations. A row has up to four bodies, so they are solved
/// one after another.
#pragma once

#include "schedule/contact_rows.h"
#include "ties/coupling_row.h"
#include "world/tie.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace plumb {

template <class Real>
class CouplingSolver {
public:
    /// `in_island` [coupling]: 1 where an exact island solves it in this step.
    explicit CouplingSolver(const std::vector<std::uint8_t>& in_island) : in_island_(in_island) {}

    bool empty() const { return rows_.empty(); }
    bool all_in_island() const {
        return std::all_of(in_island_.begin(), in_island_.end(),
                           [](std::uint8_t solved) { return solved != 0; });
    }

    void begin(const World& world, double h) {
        rows_.resize(world.joints.couplings.size());
        for (std::uint32_t i = 0; i < rows_.size(); ++i) {
            const JointCoupling& coupling = world.joints.couplings[i];
            Row row;
            row.formula = coupling_row(world, coupling, h);
            for (std::uint32_t k = 0; k < row.formula.count; ++k) {
                const CouplingSide& side = row.formula.sides[k];
                row.at[k] = world.bodies.row[side.body];
                row.to_v[k] = world.bodies.inverse_mass[side.body] * side.along;
                row.to_w[k] = world.bodies.world_inverse_inertia[side.body] * side.turn;
            }
            const double response = row.formula.response(world.bodies);
            const bool acts = holds(world, {TieKind::coupling, i}) && !in_island_[i];
            row.mass = acts && response > 0 ? 1 / response : 0;
            rows_[i] = row;
        }
    }

    void solve(const BodyRows<Real>& bodies) {
        for (Row& row : rows_) {
            if (row.mass == 0) continue;
            double rate = row.formula.bias;
            for (std::uint32_t k = 0; k < row.formula.count; ++k)
                rate += rate_of(row.formula.sides[k], bodies, row.at[k]);
            const double impulse = -row.mass * rate;
            row.lambda += impulse;
            push(row, bodies, impulse);
        }
    }

    void store_impulses(JointTable& table) const {
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            if (in_island_[i]) continue;
            table.couplings[i].impulse = rows_[i].lambda;
            table.couplings[i].deferred = rows_[i].formula.deferred;
        }
    }

private:
    struct Row {
        CouplingRow formula;
        std::array<std::int32_t, 4> at{};    ///< rows of its bodies
        std::array<Vector3d, 4> to_v, to_w;  ///< what an impulse of 1 does to them
        double mass = 0, lambda = 0;
    };

    static double rate_of(const CouplingSide& side, const BodyRows<Real>& bodies, std::int32_t at) {
        const Real* start = bodies.start + at * kBodyRowSize;
        const Real* change = bodies.change + at * kBodyRowSize;
        double rate = 0;
        for (int k = 0; k < 3; ++k)
            rate += side.along[k] * (double(start[k]) + double(change[k])) +
                    side.turn[k] * (double(start[4 + k]) + double(change[4 + k]));
        return rate;
    }

    static void push(const Row& row, const BodyRows<Real>& bodies, double impulse) {
        for (std::uint32_t i = 0; i < row.formula.count; ++i) {
            if (row.at[i] >= bodies.dynamic_count) continue;
            Real* change = bodies.change + row.at[i] * kBodyRowSize;
            for (int k = 0; k < 3; ++k) {
                change[k] += static_cast<Real>(row.to_v[i][k] * impulse);
                change[4 + k] += static_cast<Real>(row.to_w[i][k] * impulse);
            }
        }
    }

    const std::vector<std::uint8_t>& in_island_;
    std::vector<Row> rows_;
};

}  // namespace plumb
