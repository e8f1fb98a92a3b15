// SPDX-License-Identifier: MIT
#include "solve/contact_stiffness.h"

#include "math/matrices.h"
#include "scene/geometry.h"

#include <algorithm>

namespace plumb {
namespace {

/// Points of a surface that no element has in common are held no less than the whole.
void add_between(std::uint32_t i, std::uint32_t j, const Matrix3d& block, SparseLdlt& system) {
    if (const auto slot = system.find_slot(i, j)) return system.add(*slot, block);
    system.add(i, block), system.add(j, block);
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

/// A row that holds a change of its rate by `stiffness`.
void add_row(const KeptFactors::Row& row, std::uint32_t first_row, SparseLdlt& system) {
    for (std::uint32_t k = 0; k < row.count; ++k) {
        const std::uint32_t i = first_row + 2 * row.body[k];
        const Vector3d force = row.stiffness * row.on[k].head<3>(),
                       torque = row.stiffness * row.on[k].tail<3>();
        for (std::uint32_t l = k; l < row.count; ++l) {
            const std::uint32_t j = first_row + 2 * row.body[l];
            const Vector3d along = row.on[l].head<3>(), turn = row.on[l].tail<3>();
            system.add_more(i, j, force * along.transpose());
            system.add_more(i, j + 1, force * turn.transpose());
            if (k != l) system.add_more(i + 1, j, torque * along.transpose());
            system.add_more(i + 1, j + 1, torque * turn.transpose());
        }
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
    for (const KeptFactors::Row& row : made_of.rows) {
        double rate = 0;
        for (std::uint32_t k = 0; k < row.count; ++k) {
            const std::uint32_t at = first_row + 2 * row.body[k];
            rate += row.on[k].head<3>().dot(way[at]) + row.on[k].tail<3>().dot(way[at + 1]);
        }
        sum += row.stiffness * rate * rate;
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
            const auto at = std::lower_bound(pairs.begin(), pairs.end(),
                                             SparseLdlt::Pair(particle, row_of(c.body[1])));
            const std::size_t pair = first_pair + static_cast<std::size_t>(at - pairs.begin());
            system.add_pair(pair, -c.weight[k] * d);
            system.add_pair(pair + 1, c.weight[k] * d * skew(c.arm[1]));
        }
        for (int i = 0; i < 2; ++i)
            if (c.body[i] != kNoIndex)
                add_bodies(d, row_of(c.body[i]), c.arm[i], row_of(c.body[i]), c.arm[i], system);
        if (c.body[0] != kNoIndex && c.body[1] != kNoIndex)
            add_bodies(-d, row_of(c.body[0]), c.arm[0], row_of(c.body[1]), c.arm[1], system);
    }
    for (const KeptFactors::Row& kept : made_of.rows) add_row(kept, first_row, system);
}

}  // namespace plumb
