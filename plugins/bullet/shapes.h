// SPDX-License-Identifier: MIT
/// Bullet's shapes for our parts.
///
/// Bullet's closest points stand on a core and a margin around it. A sharp shape gets its true size
/// as the core and a small cushion as the margin, which is subtracted again from every answer: so
/// edges and vertices stay exact, and a slight overlap is still an answer of the closest-point
/// query and not of the penetration solver.
#pragma once

#include "manifold/manifold.h"

#include <btBulletCollisionCommon.h>

#include <memory>
#include <vector>

namespace plumb::bullet {

inline constexpr double kCushion = 1e-3;  ///< [m]; less for parts smaller than a hundred cushions

/// What hangs on a part.
struct Shapes {
    std::unique_ptr<btConvexShape> cushioned;  ///< all convex kinds
    double cushion = 0;                        ///< of `cushioned`; 0 for sphere and capsule [m]
    std::unique_ptr<btBoxShape> exact_box;     ///< boxes only
    std::unique_ptr<btBoxShape> grown_box;     ///< boxes only: larger by the part's expansion
    std::unique_ptr<btTriangleIndexVertexArray> triangles;  ///< behind a mesh or height field
    std::vector<std::uint32_t> corners;                     ///< behind a height field
    std::unique_ptr<btCollisionShape> other;                ///< plane, mesh, height field
    btMatrix3x3 turn;                                       ///< shape frame → world

    /// The shape that stands for the part in Bullet's own algorithms.
    btCollisionShape* any() const { return cushioned ? cushioned.get() : other.get(); }
};

inline Shapes& shapes_of(const Part& part) { return *static_cast<Shapes*>(part.backend.get()); }

std::shared_ptr<Shapes> make_shapes(const Part& part);

/// A single triangle, to be filled by `fit_triangle`.
std::shared_ptr<Shapes> make_triangle();

/// Fits a shape of `make_triangle` to a part that is a triangle: its vertices and its world frame.
void fit_triangle(const Part& triangle);

/// Moves a part to its world frame and fits the grown box to its expansion.
void place_shapes(const Part& part);

inline btScalar bt(double x) { return static_cast<btScalar>(x); }
inline btVector3 bt(Vec3 v) { return {bt(v.x), bt(v.y), bt(v.z)}; }
inline Vec3 from(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace plumb::bullet
