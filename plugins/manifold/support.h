// SPDX-License-Identifier: MIT
/// Support functions of the true shapes: how far a shape reaches along a direction, and which face
/// it shows there.
///
/// A round shape is a core and a radius (`core_radius`): sphere a point, capsule a segment. All
/// others are sharp.
#pragma once

#include "manifold/body_table.h"

namespace plumb {

/// Farthest point of a part's core along `d`, world frame. Planes and meshes have none.
Vec3 core_support(const Part& part, Vec3 d);

/// How far the surface lies from the core [m].
inline double core_radius(const Part& part) {
    const ShapeKind kind = part.shape.kind;
    return kind == ShapeKind::sphere || kind == ShapeKind::capsule ? part.shape.radius : 0.0;
}

/// Signed gap of two parts along the unit normal n (out of b towards a) [m]: the true one where n
/// is right, and never more than it. A plane as b or a needs n to be its own normal.
double support_gap(const Part& a, const Part& b, Vec3 n);

/// What a part shows in a direction: a point, a segment, or a polygon (counter-clockwise seen from
/// outside).
struct SupportFace {
    static constexpr int kMost = 48;
    Vec3 corner[kMost];  ///< of the core [m]
    int count = 0;
    std::uint32_t id =
        0;  ///< names the face; a corner or an edge is named by the face and its place in it
    double radius = 0;       ///< of a round shape's skin [m]
    double side_radius = 0;  ///< segment on a cylinder's side: distance of its axis [m]
    Vec3 normal{};           ///< of a polygon, unit
    Vec3 rim_centre{};       ///< of a flat round end, whose corners are some of its rim [m]
    double rim_radius = 0;   ///< [m]; 0: not round

    void add(Vec3 p) {
        if (count < kMost) corner[count++] = p;
    }
};

/// The face of a part that looks along the unit vector `d`; it holds the farthest point along d.
/// `around` bounds a plane's face: it is cut to a square of half side `half` about that point.
SupportFace support_face(const Part& part, Vec3 d, Vec3 around, double half);

/// Half the diagonal of a part's own box, about a length of the shape [m]; 0 for planes.
double size_of(const Part& part);

}  // namespace plumb
