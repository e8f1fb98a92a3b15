// SPDX-License-Identifier: MIT
#include "geometry/mass_properties.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace plumb {
namespace {

constexpr double kPi = std::numbers::pi;

Matrix3d diagonal(double x, double y, double z) { return Vector3d(x, y, z).asDiagonal(); }

MassProperties box(const Vector3d& h) {
    const double v = 8 * h.x() * h.y() * h.z();
    const Vector3d s = h.cwiseProduct(h) / 3;
    return {v, Vector3d::Zero(), v * diagonal(s.y() + s.z(), s.z() + s.x(), s.x() + s.y())};
}

MassProperties sphere(double r) {
    const double v = 4.0 / 3 * kPi * r * r * r;
    return {v, Vector3d::Zero(), 0.4 * v * r * r * Matrix3d::Identity()};
}

MassProperties cylinder(double r, double h) {
    const double v = 2 * kPi * r * r * h, across = v * (r * r / 4 + h * h / 3);
    return {v, Vector3d::Zero(), diagonal(across, v * r * r / 2, across)};
}

/// A cylinder and two half-balls, whose centres of mass lie 3r/8 beyond the cylinder's ends.
MassProperties capsule(double r, double h) {
    const MassProperties middle = cylinder(r, h), ball = sphere(r);
    const double shift = h + 3.0 / 8 * r;
    const double across = ball.volume * (83.0 / 320 * r * r + shift * shift);
    return {middle.volume + ball.volume, Vector3d::Zero(),
            middle.inertia + diagonal(across, 0.4 * ball.volume * r * r, across)};
}

/// Height 2h with the base at −h: the centre of mass is a quarter of the height above the base.
MassProperties cone(double r, double h) {
    const double v = kPi * r * r * 2 * h / 3,
                 across = v * (3.0 / 20 * r * r + 3.0 / 80 * 4 * h * h);
    return {v, Vector3d(0, -h / 2, 0), diagonal(across, 0.3 * v * r * r, across)};
}

/// Sums over tetrahedra from the origin to each triangle of a closed surface.
class Tetrahedra {
public:
    void add(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
        const double v = a.dot(b.cross(c)) / 6;
        volume_ += v;
        first_ += v / 4 * (a + b + c);
        const Vector3d s = a + b + c;
        second_ += v / 20 *
                   (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
    MassProperties result() const {
        if (!(volume_ > 0)) return {};
        const Vector3d centre = first_ / volume_;
        const Matrix3d central = second_ - volume_ * centre * centre.transpose();
        return {volume_, centre, central.trace() * Matrix3d::Identity() - central};
    }

private:
    double volume_ = 0;
    Vector3d first_ = Vector3d::Zero();   // ∫ x
    Matrix3d second_ = Matrix3d::Zero();  // ∫ x xᵀ
};

MassProperties polyhedron(const Geometry& g) {
    Tetrahedra sum;
    const Vector3d from =
        g.vertices.empty() ? Vector3d::Zero() : g.vertices[0];  // keeps digits far from the origin
    auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        sum.add(g.vertices[a] - from, g.vertices[b] - from, g.vertices[c] - from);
    };
    for (const auto& face : g.faces)
        for (std::size_t i = 2; i < face.size(); ++i) add(face[0], face[i - 1], face[i]);
    for (const auto& t : g.triangles) add(t[0], t[1], t[2]);
    MassProperties m = sum.result();
    m.centre += from;
    return m;
}

/// Parts side by side; where they overlap they count twice.
MassProperties compound(const Geometry& g) {
    MassProperties sum;
    std::vector<MassProperties> parts;
    for (const GeometryPart& part : g.parts) {
        MassProperties m = mass_properties(part.geometry);
        const Matrix3d r = part.local.rotation.toRotationMatrix();
        m.centre = part.local.position + r * m.centre;
        m.inertia = r * m.inertia * r.transpose();
        sum.volume += m.volume;
        sum.centre += m.volume * m.centre;
        parts.push_back(m);
    }
    if (!(sum.volume > 0)) return {};
    sum.centre /= sum.volume;
    for (const MassProperties& m : parts) {
        const Vector3d d = m.centre - sum.centre;
        sum.inertia +=
            m.inertia + m.volume * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
    }
    return sum;
}

}  // namespace

MassProperties mass_properties(const Geometry& g) {
    switch (g.kind) {
        case ShapeKind::sphere:
            return sphere(g.radius);
        case ShapeKind::box:
            return box(g.half_extents);
        case ShapeKind::capsule:
            return capsule(g.radius, g.half_height);
        case ShapeKind::cylinder:
            return cylinder(g.radius, g.half_height);
        case ShapeKind::cone:
            return cone(g.radius, g.half_height);
        case ShapeKind::hull:
        case ShapeKind::mesh:
            return polyhedron(g);
        case ShapeKind::compound:
            return compound(g);
        case ShapeKind::plane:
        case ShapeKind::height_field:
            return {};
    }
    return {};
}

double bounding_radius(const Geometry& g, const Vector3d& centre) {
    double radius = 0;
    switch (g.kind) {
        case ShapeKind::plane:
            return std::numeric_limits<double>::infinity();
        case ShapeKind::sphere:
            return centre.norm() + g.radius;
        case ShapeKind::box:
            return centre.norm() + g.half_extents.norm();
        case ShapeKind::capsule:
            return centre.norm() + g.half_height + g.radius;
        case ShapeKind::cylinder:
        case ShapeKind::cone:
            return centre.norm() + std::hypot(g.half_height, g.radius);
        case ShapeKind::height_field:
            for (double y : g.heights) radius = std::max(radius, std::abs(y));
            return centre.norm() + std::hypot(g.columns * g.spacing_x, g.rows * g.spacing_z) / 2 +
                   radius;
        case ShapeKind::hull:
        case ShapeKind::mesh:
            for (const Vector3d& v : g.vertices) radius = std::max(radius, (v - centre).norm());
            return radius;
        case ShapeKind::compound:
            for (const GeometryPart& p : g.parts)
                radius =
                    std::max(radius, bounding_radius(p.geometry, p.local.rotation.conjugate() *
                                                                     (centre - p.local.position)));
            return radius;
    }
    return radius;
}

}  // namespace plumb
