// SPDX-License-Identifier: MIT
/// The motion of deformables' points in few bytes, for replays.
///
/// A place is three integers: place = low + quantum · integer. Of each, 16 bits are stored. Where a
/// deformable goes further than these reach, it has bases as well, the least integer in each frame:
/// the integer is then the one from there on, and below base + 2^16, that has these low bits.
///
/// A value is stored as its difference from what the two frames before it predict (value −
/// 2·previous + the one before, as bodies' are in motion_code.h), less the same difference of the
/// point before it, which is a neighbour in most shapes and moves much alike; all modulo 2^16:
///
///     for each deformable: channel x, channel y, channel z
///     channel = low bytes of all differences, point after point and within a point frame after
///         frame; then the high bytes
///
/// "Zigzag" and deflated, as those of bodies.
#pragma once

#include "output/recording.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace plumb {

/// Places of a deformable's points over a run.
struct ParticleMotion {
    std::size_t points = 0;
    std::vector<Eigen::Vector3f> places;  ///< [frame × points + point], less the origin [m]
    std::size_t frames() const { return points > 0 ? places.size() / points : 0; }
};

struct ParticleGrid {
    Eigen::Vector3d low = Eigen::Vector3d::Zero();   ///< [m]
    double quantum = 1;                              ///< [m]
    std::vector<std::array<std::int64_t, 3>> bases;  ///< [frame], or none: they are 0
};

/// The grid of a deformable: as fine as 16 bits are over its largest box of all frames, and not
/// finer than what would turn the normals of the surface by a fifth of a degree at the most.
ParticleGrid particle_grid(const RecordedDeformable& deformable, const ParticleMotion& motion);

/// Motions of all deformables as deflated bytes.
std::string encode_particles(const std::vector<ParticleMotion>& motions,
                             const std::vector<ParticleGrid>& grids);

}  // namespace plumb
