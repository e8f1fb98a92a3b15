// SPDX-License-Identifier: MIT
/// How bodies that joints hold together move as one piece: with what they hang by, or with the
/// momentum that they have. Velocities against that may be lost without a change of that momentum.
#pragma once

#include "solve/free_turn.h"
#include "ties/solved_body.h"

#include <span>

namespace plumb {

/// With the momentum that they have. `each(visit)` calls visit(body, velocity) for all of them.
template <class Each>
RigidMotion motion_as_one(const Bodies& b, Each each) {
    double mass = 0;
    Vector3d momentum = Vector3d::Zero();
    each([&](std::uint32_t i, const Velocity<double>& x) {
        mass += b.mass[i], momentum += b.mass[i] * x.v;
    });
    const FreeBodies all(b, each);
    return {all.centre, {momentum / mass, -all.turn_against(all.momentum).motion.w}};
}

/// Of the bodies of an island, of which what does not fly touches or hangs by what is immovable.
inline RigidMotion rest_of(const Bodies& b, bool flies, std::span<const SolvedBody> bodies,
                           std::span<const Vector6d> velocities) {
    if (!flies) return {};
    return motion_as_one(b, [&](auto visit) {
        for (std::size_t i = 0; i < bodies.size(); ++i)
            visit(bodies[i].body,
                  Velocity<double>{velocities[i].head<3>(), velocities[i].tail<3>()});
    });
}

/// Takes a share of the velocities against rest, of which 1 leaves rest whatever they are.
inline void brake(const Bodies& b, const RigidMotion& rest, double share,
                  std::span<const SolvedBody> bodies, std::span<Vector6d> velocities) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Velocity<double> r = rest.of(b, bodies[i].body);
        Vector6d at_rest;
        at_rest << r.v, r.w;
        Vector6d& v = velocities[i];
        v = share < 1 ? Vector6d(v - share * (v - at_rest)) : at_rest;
    }
}

}  // namespace plumb
