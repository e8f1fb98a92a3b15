// SPDX-License-Identifier: MIT
/// Shapes of the conformance suite. Memory behind hulls, meshes, height fields and compounds lives
/// until the end of the process.
#pragma once

#include <plumb/shape.h>

#include <Eigen/Geometry>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace plumb::test {

using V = Eigen::Vector3d;
using Q = Eigen::Quaterniond;

struct Place {
    V x = V::Zero();  ///< [m]
    Q q = Q::Identity();
};
inline Place operator*(const Place& outer, const Place& inner) {
    return {outer.x + outer.q * inner.x, outer.q * inner.q};
}

inline V v(const Vec3& p) { return {p.x, p.y, p.z}; }
inline Vec3 vec(const V& p) { return {p.x(), p.y(), p.z()}; }
inline Q turn(double degrees, const V& axis) {
    return Q(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()));
}
Pose pose(const Place& place);

Shape plane();
Shape sphere(double radius);
Shape box(double hx, double hy, double hz);
Shape capsule(double radius, double half_height);
Shape cylinder(double radius, double half_height);
Shape cone(double radius, double half_height);
Shape box_hull(double hx, double hy, double hz);
Shape octahedron(double radius);
Shape hull(const std::vector<V>& vertices, const std::vector<std::vector<std::uint32_t>>& faces);
Shape prism(int sides, double radius, double half_height);  ///< hull; its axis is y
Shape hull_of(const std::vector<V>& points);  ///< of points in general position: triangles
Shape triangle_mesh(const std::vector<V>& vertices, const std::vector<std::uint32_t>& triangles);
Shape grid_mesh(double half, int cells);          ///< flat, at y = 0, facing +y
Shape box_mesh(double hx, double hy, double hz);  ///< closed, 12 triangles
Shape torus_mesh(double major, double minor, int around, int across);  ///< its axis is y
Shape compound(const std::vector<std::pair<Shape, Place>>& parts);
/// Heights over a square grid of `cells` × `cells` cells from −half to half.
Shape height_field(double half, int cells, const std::function<double(double, double)>& height);

}  // namespace plumb::test
