// SPDX-License-Identifier: MIT
/// Minkowski portal refinement: the shapes overlap where their difference A − B holds the origin. A
/// ray from a point inside the difference to the origin leaves through a portal, a triangle of
/// points of its surface, which is moved outwards until the origin lies before or behind it.
#include "geometry/overlap.h"

#include <cmath>
#include <utility>

namespace plumb {

namespace {

using Eigen::Vector3d;

constexpr int kMostSteps = 100;

bool is_convex(const Geometry& g) {
    return g.kind == ShapeKind::sphere || g.kind == ShapeKind::box ||
           g.kind == ShapeKind::cylinder || g.kind == ShapeKind::hull || g.kind == ShapeKind::mesh;
}

/// The point of a shape that lies farthest along d, in its frame.
Vector3d farthest(const Geometry& g, const Vector3d& d) {
    switch (g.kind) {
        case ShapeKind::sphere:
            return g.radius * d.normalized();
        case ShapeKind::box:
            return g.half_extents.cwiseProduct(
                d.unaryExpr([](double x) { return x < 0 ? -1.0 : 1.0; }));
        case ShapeKind::cylinder: {
            const double across = std::hypot(d.x(), d.z());
            const double r = across > 0 ? g.radius / across : 0;
            return {r * d.x(), d.y() < 0 ? -g.half_height : g.half_height, r * d.z()};
        }
        default: {
            std::size_t best = 0;
            for (std::size_t i = 1; i < g.vertices.size(); ++i) {
                if (g.vertices[i].dot(d) > g.vertices[best].dot(d)) best = i;
            }
            return g.vertices[best];
        }
    }
}

/// A point inside a shape, in its frame.
Vector3d middle(const Geometry& g) {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& p : g.vertices) sum += p;
    return g.vertices.empty() ? sum : sum / static_cast<double>(g.vertices.size());
}

/// The difference A − B of two convex shapes.
struct Difference {
    const Geometry& a;
    const Placement& at_a;
    const Geometry& b;
    const Placement& at_b;

    Vector3d support(const Vector3d& d) const {
        const Vector3d on_a = farthest(a, at_a.rotation.conjugate() * d),
                       on_b = farthest(b, at_b.rotation.conjugate() * -d);
        return (at_a.position + at_a.rotation * on_a) - (at_b.position + at_b.rotation * on_b);
    }
    Vector3d inside() const {
        return (at_a.position + at_a.rotation * middle(a)) -
               (at_b.position + at_b.rotation * middle(b));
    }
};

/// Whether no point of the difference lies beyond the origin along d, but for a touch.
bool separates(const Vector3d& support, const Vector3d& d) {
    return support.dot(d) <= kTouching * d.norm();
}

/// A tetrahedron of an inner point v0 and a portal v1 v2 v3.
class Portal {
public:
    explicit Portal(const Difference& difference) : difference_(difference) {}

    /// Whether the origin lies in the difference.
    bool holds_origin() {
        v0_ = difference_.inside();
        if (v0_.norm() < kTouching) return true;
        v1_ = difference_.support(-v0_);
        if (separates(v1_, -v0_)) return false;
        Vector3d n = v1_.cross(v0_);
        if (n.norm() < 1e-12 * v1_.norm() * v0_.norm()) return true;  // straight through v1
        v2_ = difference_.support(n);
        if (separates(v2_, n)) return false;
        n = (v1_ - v0_).cross(v2_ - v0_);
        if (n.dot(v0_) > 0) std::swap(v1_, v2_), n = -n;
        return is_found(n) && is_beyond_origin();
    }

private:
    /// Moves the portal until the ray passes through it. False: the shapes are apart.
    bool is_found(Vector3d n) {
        for (int step = 0; step < kMostSteps; ++step) {
            v3_ = difference_.support(n);
            if (separates(v3_, n)) return false;
            if (v1_.cross(v3_).dot(v0_) < 0)
                v2_ = v3_;
            else if (v3_.cross(v2_).dot(v0_) < 0)
                v1_ = v3_;
            else
                return true;
            n = (v1_ - v0_).cross(v2_ - v0_);
        }
        return true;
    }

    /// Moves the portal outwards. True when the origin is on its inner side.
    bool is_beyond_origin() {
        for (int step = 0; step < kMostSteps; ++step) {
            const Vector3d n = (v2_ - v1_).cross(v3_ - v1_);
            if (n.dot(v1_) >= 0) return true;
            const Vector3d v4 = difference_.support(n);
            if (separates(v4, n) || (v4 - v3_).dot(n) <= 1e-9 * n.norm()) return false;
            replace(v4);
        }
        return false;
    }

    /// Puts v4 in place of the corner that keeps the ray within the portal.
    void replace(const Vector3d& v4) {
        const Vector3d side = v4.cross(v0_);
        if (v1_.dot(side) > 0)
            (v2_.dot(side) > 0 ? v1_ : v3_) = v4;
        else
            (v3_.dot(side) > 0 ? v2_ : v1_) = v4;
    }

    const Difference& difference_;
    Vector3d v0_, v1_, v2_, v3_;
};

}  // namespace

bool overlap(const Geometry& a, const Placement& at_a, const Geometry& b, const Placement& at_b) {
    if (b.kind == ShapeKind::compound && a.kind != ShapeKind::compound)
        return overlap(b, at_b, a, at_a);
    if (a.kind == ShapeKind::compound) {
        for (const GeometryPart& part : a.parts) {
            if (overlap(part.geometry, at_a * part.local, b, at_b)) return true;
        }
        return false;
    }
    if (!is_convex(a) || !is_convex(b)) return false;
    const Difference difference{a, at_a, b, at_b};
    return Portal(difference).holds_origin();
}

}  // namespace plumb
