// SPDX-License-Identifier: MIT
/// What the factors of deformables as one system were made of, as long as these are in use: from it
/// a saved state makes the same ones again.
#pragma once

#include "math/types.h"

#include <array>
#include <cstdint>
#include <vector>

namespace plumb {

struct KeptFactors {
    struct Body {
        std::uint32_t index;  ///< in the world's table
        double mass;          ///< [kg]
        Matrix3d inertia;     ///< world frame [kg m²]

        bool operator==(const Body&) const = default;
    };
    /// A contact that pushed, of a body with up to three particles or with another body.
    struct Contact {
        std::uint32_t points;  ///< particles: 0, 1 or 3
        std::array<std::uint32_t, 3> particle;
        std::array<double, 3> weight;
        std::array<std::uint32_t, 2> body;  ///< of each side in `bodies`, or kNoIndex
        std::array<Vector3d, 2> arm;        ///< from its centre [m]
        Matrix3d stiffness;                 ///< against a change of velocity [kg]

        bool operator==(const Contact&) const = default;
    };

    /// A row of a tie that held, of up to four bodies.
    struct Row {
        std::uint32_t count;                ///< bodies
        std::array<std::uint32_t, 4> body;  ///< in `bodies`
        std::array<Vector6d, 4> on;         ///< (force, torque) of an impulse of 1
        double stiffness;                   ///< against a change of its rate [kg], [kg m²]

        bool operator==(const Row&) const = default;
    };

    std::vector<Vector3d> places;  ///< [particle], or none [m]
    std::vector<Vector3d> before;  ///< those from which a step had led there
    std::vector<Body> bodies;
    std::vector<Contact> contacts;
    std::vector<Row> rows;

    void clear() { places.clear(), before.clear(), bodies.clear(), contacts.clear(), rows.clear(); }
    bool operator==(const KeptFactors&) const = default;
};

}  // namespace plumb
