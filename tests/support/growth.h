// SPDX-License-Identifier: MIT
/// The step as a map: by how much a small disturbance of what rests grows or dies away.
#pragma once

#include "host/simulation.h"
#include "support/structures.h"

#include <Eigen/SVD>

#include <cmath>
#include <string>
#include <vector>

namespace plumb::test {

/// Ground and structure under given settings.
inline Scene scene_of(const Structure& structure, const Settings& settings) {
    Scene s;
    s.settings = settings;
    add_ground(s);
    add_structure(s, structure);
    return s;
}

/// Positions, turns and velocities against those of another run; turns times the bodies' radii and
/// velocities times h [s], so that all are lengths [m].
inline Eigen::VectorXd difference(const World& now, const World& reference, double h) {
    const Bodies &b = now.bodies, &r = reference.bodies;
    Eigen::VectorXd d(12 * (static_cast<Eigen::Index>(b.size()) - 1));
    for (std::size_t i = 1; i < b.size(); ++i) {
        const Eigen::Quaterniond turn = b.orientation[i] * r.orientation[i].conjugate();
        const Eigen::Vector3d angle = (turn.w() < 0 ? -2 : 2) * turn.vec();
        d.segment<12>(12 * (static_cast<Eigen::Index>(i) - 1)) << b.position[i] - r.position[i],
            angle * b.bounding_radius[i], (b.velocity[i] - r.velocity[i]) * h,
            (b.angular_velocity[i] - r.angular_velocity[i]) * h * b.bounding_radius[i];
    }
    return d;
}

/// The factor by which the most unstable disturbance grows in a step; at most 1 where all die away
/// or stay. Each body is given each of its six velocities in turn, a tenth of what gravity makes
/// in a substep, so that no contact opens, after `rest` steps; what that has come to is compared
/// after `steps` more and after twice as many.
inline double growth(const Structure& structure, const Settings& settings,
                     const ColliderLibrary& colliders, const std::string& collider, int rest,
                     int steps) {
    const Scene scene = scene_of(structure, settings);
    const double h = settings.dt / settings.substeps, size = 0.1 * 9.81 * h;
    const auto run = [](Simulation& s, int n) {
        for (int i = 0; i < n; ++i) s.step();
    };
    Simulation reference(scene, colliders, collider), at_end(scene, colliders, collider);
    run(reference, rest + steps);
    run(at_end, rest + 2 * steps);
    const auto columns = static_cast<Eigen::Index>(6 * structure.size());
    Eigen::MatrixXd half(2 * columns, columns), whole(2 * columns, columns);
    for (Eigen::Index c = 0; c < columns; ++c) {
        Simulation s(scene, colliders, collider);
        run(s, rest);
        const auto body = static_cast<std::uint32_t>(c / 6 + 1);
        Eigen::Vector3d v = s.world().bodies.velocity[body],
                        w = s.world().bodies.angular_velocity[body];
        if (c % 6 < 3)
            v[c % 3] += size;
        else
            w[c % 3] += size / s.world().bodies.bounding_radius[body];
        s.set_velocity(body, v, w);
        run(s, steps);
        half.col(c) = difference(s.world(), reference.world(), h) / size;
        run(s, steps);
        whole.col(c) = difference(s.world(), at_end.world(), h) / size;
    }
    const auto norm = [](const Eigen::MatrixXd& m) { return m.jacobiSvd().singularValues()[0]; };
    // what has died away to what a step counts as rest has not grown
    const double least = 1e-3 * h;
    return std::pow(std::max(norm(whole), least) / std::max(norm(half), least), 1.0 / steps);
}

}  // namespace plumb::test
