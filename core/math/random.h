// SPDX-License-Identifier: MIT
/// Random numbers that are the same on every machine.
///
/// SplitMix64: the state grows by 0x9e3779b97f4a7c15 a draw, and two rounds of xor-shift and
/// multiply scramble it (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014).
/// Only IEEE's exactly rounded operations follow, no sine and no standard distribution, so results
/// do not hang on a library.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

namespace plumb {

class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }

    /// Uniform in [0, 1), a multiple of 2^-53.
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

    /// Uniform in [low, high).
    double between(double low, double high) { return low + (high - low) * unit(); }

    /// Uniform among 0 … count − 1, for counts far below 2^53.
    std::size_t below(std::size_t count) {
        return static_cast<std::size_t>(unit() * static_cast<double>(count));
    }

    /// Uniform over all rotations (Marsaglia: Choosing a point from the surface of a sphere, 1972):
    /// two points of the unit disc, the second stretched so that the four coordinates have
    /// length 1.
    Eigen::Quaterniond rotation() {
        const Eigen::Vector2d p = in_disc();
        Eigen::Vector2d q = in_disc();
        while (q.squaredNorm() == 0) q = in_disc();
        q *= std::sqrt((1 - p.squaredNorm()) / q.squaredNorm());
        return {q.y(), p.x(), p.y(), q.x()};
    }

private:
    Eigen::Vector2d in_disc() {
        for (;;) {
            const double x = between(-1, 1), y = between(-1, 1);
            if (x * x + y * y < 1) return {x, y};
        }
    }

    std::uint64_t state_;
};

}  // namespace plumb
