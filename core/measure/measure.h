// SPDX-License-Identifier: MIT
/// Numbers that describe a world.
#pragma once

#include "measure/frame.h"
#include "world/world.h"

#include <cstdint>
#include <vector>

namespace plumb {

double kinetic_energy(const World& world);  ///< [J]
double potential_energy(
    const World& world);  ///< of gravity and constant forces, against the origin [J]
Vector3d linear_momentum(const World& world);   ///< [kg m/s]
Vector3d angular_momentum(const World& world);  ///< about the origin [kg m²/s]

/// Depth of the deepest point of each pair that penetrates [m], from the contacts of the last
/// detection.
std::vector<double> penetrations(const World& world);

/// How far each joint's points have parted along what it locks, or past a limit [m]; 0 of broken
/// ones and of what gives way.
std::vector<double> joint_errors(const World& world);

/// How far each joint's bodies have turned against each other about what it locks, or past a limit
/// [rad]; the same.
std::vector<double> joint_turn_errors(const World& world);

/// By how much each coupling's second coordinate misses what the first asks for [m], [rad].
std::vector<double> coupling_errors(const World& world);

/// How far each link's points are from where it holds them [m]; 0 of links that give way.
std::vector<double> link_errors(const World& world);

/// 64-bit hash (FNV-1a) of all bodies' positions, orientations and velocities, bit for bit.
std::uint64_t state_hash(const World& world);

/// What watchers get to see.
void capture(const World& world, Frame& frame);

/// Value at share p in [0, 1] of the sorted values; 0 of none.
double percentile(std::vector<double> values, double p);

}  // namespace plumb
