// SPDX-License-Identifier: MIT
#include "solve/contact_stiffness.h"

#include "math/matrices.h"
#include "scene/geometry.h"

#include <algorithm>

namespace plumb {
namespace {

/// A saved state may name pairs that have no block: factors are only near without them.
void add_between(std::uint32_t i, std::uint32_t j, const Matrix3d& block, SparseLdlt& system) {
    if (const auto slot = system.find_slot(i, j)) system.add(*slot, block);
}

/// What d holds between two points, each of which moves with v − r × ω of its body.
void add_bodies(const Matrix3d& d, std::uint32_t i, const Vector3d& arm_i, std::uint32_t j,
                const Vector3d& arm_j, SparseLdlt& system) {
    const Matrix3d of_i = skew(arm_i), d_j = d * skew(arm_j);
    system.add_more(i, j, d);
    system.add_more(i, j + 1, -d_j);
    if (i != j) system.add_more(i + 1, j, of_i * d);
    system.add_more(i + 1, j + 1, -of_i * d_j);
}

/// Where the blocks of pairs (particle, attached row) are.
class PairBlocks {
public:
    PairBlocks(const std::vector<SparseLdlt::Pair>& pairs, std::size_t first, SparseLdlt& system)
        : pairs_(pairs), first_(first), system_(system) {}

    /// Adds to A(particle, row).
    void add(std::uint32_t particle, std::uint32_t row, const Matrix3d& block) const {
        const auto at =
            std::lower_bound(pairs_.begin(), pairs_.end(), SparseLdlt::Pair(particle, row));
        system_.add_pair(first_ + static_cast<std::size_t>(at - pairs_.begin()), block);
    }

private:
    const std::vector<SparseLdlt::Pair>& pairs_;
    std::size_t first_;
    SparseLdlt& system_;
};

/// The rows of what a row of a tie ties, and what an impulse of 1 on it does in each.
struct TiedRow {
    std::uint32_t row;
    Vector3d on;
};
template <class Visit>
void each_tied_row(const KeptFactors& made_of, const KeptFactors::Row& tie, std::uint32_t first_row,
                   Visit visit) {
    for (std::uint32_t k = 0; k < tie.count; ++k) {
        const std::size_t body = tie.body[k], bodies = made_of.bodies.size();
        if (body >= bodies) {
            visit(TiedRow{made_of.points[body - bodies], tie.on[k].head<3>()});
            continue;
        }
        const auto row = static_cast<std::uint32_t>(first_row + 2 * body);
        visit(TiedRow{row, tie.on[k].head<3>()});
        visit(TiedRow{row + 1, tie.on[k].tail<3>()});
    }
}

/// A row of a tie that holds a change of its rate by `stiffness`.
void add_tie(const KeptFactors& made_of, const KeptFactors::Row& tie, std::uint32_t first_row,
             const PairBlocks& pairs, SparseLdlt& system) {
    std::array<TiedRow, 8> rows;
    std::size_t n = 0;
    each_tied_row(made_of, tie, first_row, [&](const TiedRow& row) { rows[n++] = row; });
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t l = 0; l <= k; ++l) {
            const TiedRow &x = rows[k], &y = rows[l];
            const Matrix3d block = tie.stiffness * x.on * y.on.transpose();
            const bool is_point[2] = {x.row < first_row, y.row < first_row};
            if (k == l)
                system.add(x.row, block);
            else if (is_point[0] && is_point[1])
                add_between(x.row, y.row, block, system);
            else if (is_point[0])
                pairs.add(x.row, y.row, block);
            else if (is_point[1])
                pairs.add(y.row, x.row, block.transpose());
            else
                system.add_more(x.row, y.row, block);
        }
}

}  // namespace

void list_pairs(const KeptFactors& made_of, std::uint32_t first_row,
                std::vector<SparseLdlt::Pair>& pairs) {
    for (const KeptFactors::Contact& c : made_of.contacts)
        for (std::uint32_t k = 0; k < c.points; ++k)
            if (c.body[1] != kNoIndex)
                for (std::uint32_t i = 0; i < 2; ++i)
                    pairs.emplace_back(c.particle[k], first_row + 2 * c.body[1] + i);
    for (const KeptFactors::Row& tie : made_of.rows)
        each_tied_row(made_of, tie, first_row, [&](const TiedRow& x) {
            if (x.row >= first_row) return;
            each_tied_row(made_of, tie, first_row, [&](const TiedRow& y) {
                if (y.row >= first_row) pairs.emplace_back(x.row, y.row);
            });
        });
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

double stiffness_along(const KeptFactors& made_of, std::uint32_t first_row,
                       const std::vector<Vector3d>& way) {
    constexpr double kSign[2] = {1, -1};
    double sum = 0;
    for (const KeptFactors::Contact& c : made_of.contacts) {
        Vector3d u = Vector3d::Zero();
        for (std::uint32_t k = 0; k < c.points; ++k) u += c.weight[k] * way[c.particle[k]];
        for (int i = 0; i < 2; ++i) {
            if (c.body[i] == kNoIndex) continue;
            const std::uint32_t row = first_row + 2 * c.body[i];
            u += kSign[i] * (way[row] + way[row + 1].cross(c.arm[i]));
        }
        sum += u.dot(c.stiffness * u);
    }
    for (const KeptFactors::Row& tie : made_of.rows) {
        double rate = 0;
        each_tied_row(made_of, tie, first_row,
                      [&](const TiedRow& row) { rate += row.on.dot(way[row.row]); });
        sum += tie.stiffness * rate * rate;
    }
    return sum;
}

void add_contact_stiffness(const KeptFactors& made_of, const std::vector<double>& mass,
                           std::uint32_t first_row, const std::vector<SparseLdlt::Pair>& pairs,
                           std::size_t first_pair, SparseLdlt& system) {
    std::uint32_t row = first_row;
    for (const KeptFactors::Body& body : made_of.bodies) {
        system.add(row++, body.mass * Matrix3d::Identity());
        system.add(row++, body.inertia);
    }
    const auto row_of = [&](std::uint32_t body) { return first_row + 2 * body; };
    const PairBlocks blocks(pairs, first_pair, system);
    for (const KeptFactors::Contact& c : made_of.contacts) {
        const Matrix3d& d = c.stiffness;
        for (std::uint32_t k = 0; k < c.points; ++k) {
            const std::uint32_t particle = c.particle[k];
            if (mass[particle] == 0) continue;
            system.add(particle, c.weight[k] * c.weight[k] * d);
            for (std::uint32_t l = k + 1; l < c.points; ++l)
                if (mass[c.particle[l]] > 0)
                    add_between(particle, c.particle[l], c.weight[k] * c.weight[l] * d, system);
            if (c.body[1] == kNoIndex) continue;
            blocks.add(particle, row_of(c.body[1]), -c.weight[k] * d);
            blocks.add(particle, row_of(c.body[1]) + 1, c.weight[k] * d * skew(c.arm[1]));
        }
        for (int i = 0; i < 2; ++i)
            if (c.body[i] != kNoIndex)
                add_bodies(d, row_of(c.body[i]), c.arm[i], row_of(c.body[i]), c.arm[i], system);
        if (c.body[0] != kNoIndex && c.body[1] != kNoIndex)
            add_bodies(-d, row_of(c.body[0]), c.arm[0], row_of(c.body[1]), c.arm[1], system);
    }
    for (const KeptFactors::Row& tie : made_of.rows)
        add_tie(made_of, tie, first_row, blocks, system);
}

}  // namespace plumb
