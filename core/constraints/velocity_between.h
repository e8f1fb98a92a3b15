// SPDX-License-Identifier: MIT
#pragma once

#include "constraints/connector.h"
#include "math/rotation.h"
#include "scene/scene.h"

namespace plumb {

/// That leads from one placement to another in h [s]; the rotation of the first is a unit
/// quaternion.
inline Velocity<double> velocity_between(const Placement& from, const Placement& to, double h) {
    return {(to.position - from.position) / h,
            rotation_vector(to.rotation.normalized() * from.rotation.conjugate()) / h};
}

}  // namespace plumb
