// SPDX-License-Identifier: MIT
/// Random numbers, directions and rotations, the same in every run.
#pragma once

#include "shapes.h"

#include <random>

namespace plumb::test {

class Dice {
public:
    explicit Dice(unsigned seed) : random_(seed) {}

    double between(double low, double high) {
        return low + (high - low) * std::uniform_real_distribution<double>()(random_);
    }
    /// A point of a cube of this half width.
    V within(double half) {
        const double x = between(-half, half), y = between(-half, half), z = between(-half, half);
        return {x, y, z};
    }
    V direction() {
        V d;
        do d = normal_vector();
        while (d.norm() < 1e-3);
        return d.normalized();
    }
    Q rotation() {
        std::normal_distribution<double> normal;
        return Q(normal(random_), normal(random_), normal(random_), normal(random_)).normalized();
    }

private:
    V normal_vector() {
        std::normal_distribution<double> normal;
        const double x = normal(random_), y = normal(random_), z = normal(random_);
        return {x, y, z};
    }

    std::mt19937 random_;
};

}  // namespace plumb::test
