// SPDX-License-Identifier: MIT
/// Inverse masses and inertias by the rows of the velocity table, for lanes to take them from whole
/// rows: written into lanes one by one, those of a pair would touch a line of memory for each of
/// their numbers.
#pragma once

#include "schedule/contact_rows.h"
#include "world/world.h"

#include <vector>

namespace plumb {

template <class Real>
class MassTable {
public:
    /// At the poses now. Rows of what no force moves are zero.
    void fill(const World& world) {
        const Bodies& bodies = world.bodies;
        rows_.assign((static_cast<std::size_t>(world.zero_row()) + 1) * kBodyRowSize, Real(0));
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (bodies.motion[i] != Motion::dynamic) continue;
            const Symmetric3<double>& m = bodies.world_inverse_inertia[i];
            const double numbers[7] = {bodies.inverse_mass[i], m.xx, m.yy, m.zz, m.xy, m.xz, m.yz};
            Real* row = rows_.data() + bodies.row[i] * kBodyRowSize;
            for (int k = 0; k < 7; ++k) row[k] = static_cast<Real>(numbers[k]);
        }
    }

    const Real* rows() const { return rows_.data(); }

private:
    std::vector<Real> rows_;  // [row] 1/m, then xx yy zz xy xz yz of the inertia; world frame
};

}  // namespace plumb
