// SPDX-License-Identifier: MIT
/// When two answers about the same poses count as the same contact set.
///
/// L, the size of a pair, is the longest side of the smaller body's own box (a plane is no body
/// in this sense). Where two back-ends are as good as their precision, they agree to these
/// tolerances; a mesh stands for a smooth surface only as far as its facets do, so its tolerances
/// are multiples of its sagitta (mesh_resolution.h).
#pragma once

#include <cstdint>

namespace plumb {

/// What is known of two answers before they are compared.
struct ComparisonKind {
    bool single_precision = false;  ///< one of the two colliders is
    bool raw = false;               ///< what the back-ends said, without shared clipping
};

/// Limits for one pair of bodies. Lengths in metres, unless said.
struct PairTolerances {
    double size;            ///< L [m]
    double grazing;         ///< half-width of the bands about gap = 0 and gap = margin
    bool only_overlap;      ///< pairs that do not overlap are not asked of both
    double gap;             ///< of the deepest gaps, to a depth of `kShallow` L
    double deep_gap;        ///< of the deepest gaps, deeper than that
    double normal_degrees;  ///< between the normals (meshes: the mean normals)
    double extent;          ///< greatest deficit of the smaller patch: 1 − ratio of areas or
                            ///< lengths; meshes: of the footprints' distance to the edge length
};

inline constexpr double kShallow = 0.01;      ///< [L] gaps are precise to this depth
inline constexpr double kDeep = 0.05;         ///< [L] normals are judged to this depth
inline constexpr double kEqualAxes = 1e-3;    ///< [L] axes whose gaps differ less are equal
inline constexpr double kLeastExtent = 0.01;  ///< [L] smaller patches are points

/// Shares of the pairs that must keep a tolerance.
inline constexpr double kGapShare = 0.99, kDeepGapShare = 0.99, kNormalShare = 0.995,
                        kExtentShare = 0.95;

/// Of convex bodies. Deeper overlap has no one right answer: back-ends err by 1–2 % of L there.
inline PairTolerances convex_tolerances(const ComparisonKind& kind, double size) {
    const double precise = kind.single_precision ? 2e-4 : 1e-4;
    const double grazing = kind.single_precision ? 2e-4 : 1e-6;
    return {size, grazing * size, kind.raw, precise * size, 2e-2 * size, 1, kind.raw ? 0.4 : 0.01};
}

/// Of a pair with a mesh. `sagitta`: of both meshes together [m]. A mesh without bends is taken to
/// have one of L/1000. Not every back-end reports meshes that are apart.
inline PairTolerances mesh_tolerances(const ComparisonKind&, double size, double sagitta) {
    const double s = sagitta > 1e-3 * size ? sagitta : 1e-3 * size;
    const double degrees = s > 5e-3 * size ? 12 : 6;
    return {size, s, true, 2 * s, 2e-2 * size + 2 * s, degrees, 1};
}

}  // namespace plumb
