// SPDX-License-Identifier: MIT
/// A distance joint that pulls resists being swung aside, as the rod of a pendulum does: its
/// impulse λ turns with the line between the points, which is a stiffness −λ/L across the line for
/// displacements h Δv. Newton's matrix takes it as two soft rows that ask for nothing.
#pragma once

#include "constraints/tree_block.h"

namespace plumb {

/// `along`: unit vector of the line; `child`, `parent`: arms of the two points [m]; `pull`: −λ > 0
/// [N s]; `length`: L [m].
template <class T>
inline void add_tension_rows(RowsElimination<T>& e, const Vector3<T>& along,
                             const Vector3<T>& child, const Vector3<T>& parent, T pull, T length,
                             T h) {
    const Vector3<T> first = along.unitOrthogonal();
    for (const Vector3<T>& t : {first, Vector3<T>(cross(along, first))})
        append_row<T>(e, t, cross(child, t), cross(parent, t), T(1), length / (h * pull), T(0));
}

}  // namespace plumb
