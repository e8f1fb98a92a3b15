// SPDX-License-Identifier: MIT
/// The motion of many bodies in few bytes, for replays.
///
/// Positions are integers of 16 bits per axis between the least and the greatest place of each
/// body; rotations have 3 × 14 bits (rotation_code.h). A value is stored as its difference from
/// what the two frames before it predict (value − 2·previous + the one before; before the first
/// frame both are 0), modulo 2^16, so that a body at rest or in even flight leaves almost nothing:
///
///     channel = x, y, z, and the three parts of the rotation:
///         low bytes of all differences, body after body and within a body frame after frame; then
///         the high bytes
///     then one byte for each body and frame: index of the largest component less that of the frame
///     before, mod 4
///
/// Differences are stored "zigzag" (0, −1, 1, −2, … as 0, 1, 2, 3, …), and everything is deflated
/// by zlib.
#pragma once

#include "output/rotation_code.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace plumb {

inline constexpr int kReplayRotationBits = 14;

/// Pose of a body in a frame, small enough to keep thousands of frames in memory.
struct PoseSample {
    std::array<float, 3> position;       ///< [m], relative to the recording's origin
    std::array<std::uint16_t, 3> small;  ///< parts of RotationCode
    std::uint16_t largest;
};

/// Rotation that is not finite becomes the identity.
PoseSample pose_sample(const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation);

/// What is needed to make places of the integers: place = low + quantum · integer.
struct PositionGrid {
    Eigen::Vector3d low = Eigen::Vector3d::Zero();  ///< [m]
    double quantum = 1;                             ///< [m]
};

/// The grid of one body. Its quantum is not finer than `finest` [m]: what nobody can see is not
/// worth its bytes.
PositionGrid position_grid(const std::vector<PoseSample>& motion, double finest);

/// Motions of all bodies, each [frame], as deflated bytes.
std::string encode_motion(const std::vector<std::vector<PoseSample>>& motions,
                          const std::vector<PositionGrid>& grids);

}  // namespace plumb
