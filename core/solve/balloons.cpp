// SPDX-License-Identifier: MIT
#include "solve/balloons.h"

#include <algorithm>

namespace plumb {
namespace {

/// A kept volume resists as if this were the bulk modulus of what fills it [Pa].
constexpr double kFilling = 1e8;

}  // namespace

Balloons::Balloons(const World& world) {
    for (const Deformable& d : world.deformables) {
        if (d.spec.kind != DeformableKind::balloon) continue;
        const double volume = kept_volume(d.spec);
        balloons_.push_back({&d.spec.triangles, d.first, d.count, volume,
                             d.spec.pressure.value_or(0), d.spec.pressure ? 0 : kFilling / volume,
                             std::vector<Vector3d>(d.count)});
        rows_ += balloons_.back().keeps_volume();
    }
}

void Balloons::add_pairs(std::uint32_t first_row, std::vector<SparseLdlt::Pair>& pairs) const {
    std::uint32_t row = first_row;
    for (const Balloon& balloon : balloons_) {
        if (!balloon.keeps_volume()) continue;
        for (std::uint32_t i = 0; i < balloon.count; ++i)
            pairs.emplace_back(balloon.first + i, row);
        ++row;
    }
}

/// Volume of a balloon, and its gradient.
double Balloons::measure(Balloon& balloon, const ParticlePlaces& x) {
    std::fill(balloon.gradient.begin(), balloon.gradient.end(), Vector3d::Zero());
    const Vector3d& origin = x[balloon.first];
    return volume_of(
        *balloon.triangles,
        [&](std::uint32_t i) -> Vector3d { return x[balloon.first + i] - origin; },
        &balloon.gradient);
}

void Balloons::add_forces(const ParticlePlaces& x, std::vector<Vector3d>& force, double& energy) {
    for (Balloon& balloon : balloons_) {
        const double missing = balloon.volume - measure(balloon, x);
        const double push = balloon.pressure + balloon.stiffness * missing;
        energy += 0.5 * (balloon.pressure + push) * missing;
        for (std::uint32_t i = 0; i < balloon.count; ++i)
            force[balloon.first + i] += push * balloon.gradient[i];
    }
}

void Balloons::add_stiffness(const ParticlePlaces& x, const std::vector<double>& mass, double h,
                             std::uint32_t first_row, SparseLdlt& system) {
    std::size_t pair = 0;
    std::uint32_t row = first_row;
    for (Balloon& balloon : balloons_) {
        if (!balloon.keeps_volume()) continue;
        measure(balloon, x);
        Matrix3d block = Matrix3d::Identity();  // two of three numbers mean nothing
        block(0, 0) = -1 / balloon.stiffness;
        system.add(row++, block);
        for (std::uint32_t i = 0; i < balloon.count; ++i, ++pair) {
            if (mass[balloon.first + i] == 0) continue;
            block.setZero();
            block.col(0) = h * balloon.gradient[i];
            system.add_pair(pair, block);
        }
    }
}

}  // namespace plumb
