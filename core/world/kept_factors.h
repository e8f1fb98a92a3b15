// SPDX-License-Identifier: MIT
/// What the factors of deformables as one system were made of, as long as these are in use: from it
/// a saved state makes the same ones again.
#pragma once

#include "math/types.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace plumb {

struct KeptFactors {
    struct Body {
        std::uint32_t index;  ///< in the world's table
        double mass;          ///< [kg]
        Matrix3d inertia;     ///< world frame [kg m²]

        bool operator==(const Body&) const = default;
    };
    /// A contact that pushed, of up to four particles and two bodies.
    struct Contact {
        std::uint32_t points;  ///< particles: 0, 1, 3 or 4
        std::array<std::uint32_t, 4> particle;
        std::array<double, 4> weight;       ///< negative on the second side
        std::array<std::uint32_t, 2> body;  ///< of each side in `bodies`, or kNoIndex
        std::array<Vector3d, 2> arm;        ///< from its centre [m]
        Matrix3d stiffness;                 ///< against a change of velocity [kg]

        bool operator==(const Contact&) const = default;
    };

    /// A row of a tie that held, of up to four bodies or points.
    struct Row {
        std::uint32_t count;                ///< of them
        std::array<std::uint32_t, 4> body;  ///< in `bodies`, or behind them in `points`
        std::array<Vector6d, 4> on;         ///< (force, torque) of an impulse of 1
        double stiffness;                   ///< against a change of its rate [kg], [kg m²]

        bool operator==(const Row&) const = default;
    };

    /// Particles, the lower one first, that have blocks because they touch; these stay when factors
    /// are dropped, for rows are eliminated in an order that hangs on them.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> near;
    std::vector<Vector3d> places;  ///< [particle], or none [m]
    std::vector<Vector3d> before;  ///< those from which a step had led there
    std::vector<Body> bodies;
    std::vector<Contact> contacts;
    std::vector<std::uint32_t> points;  ///< particles that are linked
    std::vector<Row> rows;

    void drop() {
        for (auto* column : {&places, &before}) column->clear();
        bodies.clear(), contacts.clear(), points.clear(), rows.clear();
    }
    bool operator==(const KeptFactors&) const = default;
};

}  // namespace plumb
