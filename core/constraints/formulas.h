// SPDX-License-Identifier: MIT
/// The constraints that deformables are made of. A new one is a file beside this one and a name in
/// this list; its loops, lanes, colours and threads follow from it.
///
/// A formula says among how many points it is (kPoints), and tells its items of a deformable
/// (`each`). One that is linear in its points says no more; any other has kRows rows, kNumbers
/// numbers an item, and `rows`, which makes C and its gradient of the points.
#pragma once

#include "constraints/bending.h"
#include "constraints/membrane.h"
#include "constraints/rope.h"
#include "constraints/tetrahedron.h"

namespace plumb {

template <class... Formula>
struct FormulaList {};

using Formulas = FormulaList<Stretch, RopeBend, Membrane, IsometricBend, DihedralBend, Tetrahedron>;

/// Formulas whose elements can bear a stress in common (solve/patch_solver.h): `share` is what an
/// element has of it.
template <class F>
concept HasPatches = requires(const double (&numbers)[F::kNumbers]) {
    F::share(numbers);
};
/// Those whose rows are along axes of the element's own: `turn` takes them, or their gradients,
/// into axes at an angle θ to those, of which it gets the cosine and sine of 2 θ.
template <class F>
concept HasAxes = requires(double (&rows)[F::kRows]) {
    F::turn(rows, 1.0, 0.0);
};

/// Those whose elements can turn what they have pushed with themselves: `follow` does, and moves
/// their points accordingly.
template <class F>
concept HasFollowing = requires {
    requires F::kFollows;
};

/// Sizes of a formula's blocks.
template <class F>
struct FormulaSize {
    static constexpr bool kIsLinear = true;
    static constexpr int kNumbers = F::kPoints;  ///< weights
    static constexpr int kRows = 3;              ///< one a direction
    static constexpr int kCompliances = 1;
};
template <class F>
requires requires { F::kRows; }
struct FormulaSize<F> {
    static constexpr bool kIsLinear = false;
    static constexpr int kNumbers = F::kNumbers;
    static constexpr int kRows = F::kRows;
    static constexpr int kCompliances = F::kRows;
};

}  // namespace plumb
