// SPDX-License-Identifier: MIT
#include "geometry/solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace plumb {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Distance above the plane, 0 within the tolerance.
double height(const Vector3d& p, const Plane& plane, double tolerance) {
    const double d = plane.normal.dot(p) - plane.offset;
    return std::abs(d) <= tolerance ? 0 : d;
}

/// Adds the convex polygon as facets.
void add_fan(Solid& solid, const std::vector<Vector3d>& polygon, bool cut) {
    for (std::size_t i = 2; i < polygon.size(); ++i)
        solid.push_back({{polygon[0], polygon[i - 1], polygon[i]}, cut});
}

/// A facet that has corners on both sides.
void split(const SolidFacet& facet, const std::array<double, 3>& d, OpenHalves& halves) {
    std::vector<Vector3d> below, above;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t k = (i + 1) % 3;
        const Vector3d &p = facet.corners[i], &q = facet.corners[k];
        if (d[i] <= 0) below.push_back(p);
        if (d[i] >= 0) above.push_back(p);
        if (d[i] * d[k] >= 0) continue;
        // The same point from both ends of an edge, so that neighbours agree.
        const bool forward = d[i] < d[k];
        const double low = forward ? d[i] : d[k], high = forward ? d[k] : d[i];
        const Vector3d &from = forward ? p : q, &to = forward ? q : p;
        const Vector3d crossing = from + low / (low - high) * (to - from);
        below.push_back(crossing);
        above.push_back(crossing);
    }
    add_fan(halves.below, below, facet.cut);
    add_fan(halves.above, above, facet.cut);
}

/// An edge in the plane of a cut, from left to right.
struct Edge {
    Vector2d left, right;
    double at(double x) const {
        const double t = (x - left.x()) / (right.x() - left.x());
        return left.y() + t * (right.y() - left.y());
    }
};

/// Coordinates in a plane, with u × v = normal.
struct Axes {
    Vector3d origin, u, v;
    explicit Axes(const Plane& plane)
        : origin(plane.offset * plane.normal),
          u(plane.normal.unitOrthogonal()),
          v(plane.normal.cross(u)) {}
    Vector2d flat(const Vector3d& p) const { return {u.dot(p - origin), v.dot(p - origin)}; }
    Vector3d lifted(double x, double y) const { return origin + x * u + y * v; }
};

std::vector<Edge> edges_in(const Solid& solid, const Plane& plane, const Axes& axes,
                           double tolerance) {
    std::vector<Edge> edges;
    for (const SolidFacet& facet : solid) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3d &p = facet.corners[i], &q = facet.corners[(i + 1) % 3];
            if (height(p, plane, tolerance) != 0 || height(q, plane, tolerance) != 0) continue;
            Vector2d a = axes.flat(p), b = axes.flat(q);
            if (a.x() > b.x()) std::swap(a, b);
            if (b.x() - a.x() > tolerance) edges.push_back({a, b});
        }
    }
    return edges;
}

/// Where the edges' ends lie, in rising order and apart by more than the tolerance.
std::vector<double> stations(const std::vector<Edge>& edges, double tolerance) {
    std::vector<double> all;
    for (const Edge& e : edges) all.insert(all.end(), {e.left.x(), e.right.x()});
    std::sort(all.begin(), all.end());
    std::vector<double> kept;
    for (const double x : all)
        if (kept.empty() || x - kept.back() > tolerance) kept.push_back(x);
    return kept;
}

}  // namespace

OpenHalves cut_open(const Solid& solid, const Plane& plane, double tolerance) {
    OpenHalves halves;
    for (const SolidFacet& facet : solid) {
        std::array<double, 3> d;
        for (std::size_t i = 0; i < 3; ++i) d[i] = height(facet.corners[i], plane, tolerance);
        const auto [low, high] = std::minmax({d[0], d[1], d[2]});
        if (low < 0 && high > 0) {
            split(facet, d, halves);
        } else if (low == 0 && high == 0) {
            // A facet in the plane belongs to the solid behind it.
            const auto& c = facet.corners;
            const bool up = (c[1] - c[0]).cross(c[2] - c[0]).dot(plane.normal) > 0;
            (up ? halves.below : halves.above).push_back(facet);
        } else {
            (low < 0 ? halves.below : halves.above).push_back(facet);
        }
    }
    return halves;
}

void close_at(Solid& half, const Plane& plane, double side, double tolerance) {
    const Axes axes(plane);
    const std::vector<Edge> edges = edges_in(half, plane, axes, tolerance);
    const std::vector<double> x = stations(edges, tolerance);
    // Between two stations the section is a pile of trapezoids, in and out by turns.
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        const double middle = (x[i] + x[i + 1]) / 2;
        std::vector<const Edge*> across;
        for (const Edge& e : edges)
            if (e.left.x() < middle && middle < e.right.x()) across.push_back(&e);
        std::stable_sort(across.begin(), across.end(), [&](const Edge* e, const Edge* f) {
            return e->at(middle) < f->at(middle);
        });
        for (std::size_t k = 0; k + 1 < across.size(); k += 2) {
            const Edge &e = *across[k], &f = *across[k + 1];
            if (f.at(middle) - e.at(middle) <= tolerance) continue;
            std::vector<Vector3d> corners = {
                axes.lifted(x[i], e.at(x[i])), axes.lifted(x[i + 1], e.at(x[i + 1])),
                axes.lifted(x[i + 1], f.at(x[i + 1])), axes.lifted(x[i], f.at(x[i]))};
            if (side < 0) std::reverse(corners.begin(), corners.end());
            add_fan(half, corners, true);
        }
    }
}

double volume_of(const Solid& solid, const Vector3d& from) {
    double sixfold = 0;
    for (const auto& [c, cut] : solid)
        sixfold += (c[0] - from).dot((c[1] - from).cross(c[2] - from));
    return sixfold / 6;
}

double spread_of(const Solid& solid, const Vector3d& from) {
    // Sums over the tetrahedra from the point to each facet.
    double volume = 0, second = 0;
    Vector3d first = Vector3d::Zero();
    for (const auto& [corners, cut] : solid) {
        const Vector3d a = corners[0] - from, b = corners[1] - from, c = corners[2] - from;
        const Vector3d sum = a + b + c;
        const double v = a.dot(b.cross(c)) / 6;
        volume += v;
        first += v / 4 * sum;
        second +=
            v / 20 * (a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + sum.squaredNorm());
    }
    return volume > 0 ? second - first.squaredNorm() / volume : 0;
}

std::vector<Vector3d> corners_of(const Solid& solid) {
    std::vector<Vector3d> points;
    points.reserve(3 * solid.size());
    for (const SolidFacet& facet : solid)
        points.insert(points.end(), facet.corners.begin(), facet.corners.end());
    const auto before = [](const Vector3d& a, const Vector3d& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    };
    std::sort(points.begin(), points.end(), before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

}  // namespace plumb
