// SPDX-License-Identifier: MIT
/// Places of a deformable's points in a frame of a `.plumb` file: 3 × 16 bits a point.
///
///     f32 quantum, above 0: 3 × f32 low, then for each point 3 × u16; place = low + quantum · u16
///     f32 quantum, 0: for each point 3 × f32 place
///
/// The grid spans the box about the points in that frame, so that a place is off by at most half a
/// quantum an axis, 1/131070 of the box's longest side (and by what a float loses of its distance
/// from the origin). Where the box has grown so far beyond the deformable's size at the start that
/// the error could exceed 1e-4 of that, or a place is not finite, floats stand in its place.
#pragma once

#include "math/bytes.h"

#include <Eigen/Core>
#include <span>
#include <string>

namespace plumb {

/// Appends places relative to an origin. `size`: of the deformable at the start [m].
void put_places(std::string& bytes, std::span<const Eigen::Vector3d> places,
                const Eigen::Vector3d& origin, double size);

/// Reads what `put_places` wrote; false where the bytes end before all places.
bool take_places(ByteReader& reader, std::span<Eigen::Vector3d> places,
                 const Eigen::Vector3d& origin);

}  // namespace plumb
