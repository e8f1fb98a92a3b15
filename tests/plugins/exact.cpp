// SPDX-License-Identifier: MIT
#include "exact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Farthest point of a disc about the y axis.
V on_disc(double radius, double y, const V& way) {
    const double across = std::hypot(way.x(), way.z());
    if (across < 1e-300) return {0, y, 0};
    return {radius * way.x() / across, y, radius * way.z() / across};
}

V own_support(const Shape& s, const V& d) {
    switch (s.kind) {
        case ShapeKind::sphere:
            return s.radius * d.normalized();
        case ShapeKind::box: {
            const V h = v(s.half_extents);
            return {std::copysign(h.x(), d.x()), std::copysign(h.y(), d.y()),
                    std::copysign(h.z(), d.z())};
        }
        case ShapeKind::capsule:
            return s.radius * d.normalized() + V(0, std::copysign(s.half_height, d.y()), 0);
        case ShapeKind::cylinder:
            return on_disc(s.radius, std::copysign(s.half_height, d.y()), d);
        case ShapeKind::cone: {
            const V base = on_disc(s.radius, -s.half_height, d), apex(0, s.half_height, 0);
            return d.dot(base) > d.dot(apex) ? base : apex;
        }
        default: {
            V best = v(s.vertices[0]);
            for (std::uint32_t i = 1; i < s.vertex_count; ++i)
                if (d.dot(v(s.vertices[i])) > d.dot(best)) best = v(s.vertices[i]);
            return best;
        }
    }
}

double outside_own(const Shape& s, const V& p) {
    const double across = std::hypot(p.x(), p.z());
    switch (s.kind) {
        case ShapeKind::plane:
            return p.y();
        case ShapeKind::sphere:
            return p.norm() - s.radius;
        case ShapeKind::box:
            return (p.cwiseAbs() - v(s.half_extents)).maxCoeff();
        case ShapeKind::capsule:
            return (p - V(0, std::clamp(p.y(), -s.half_height, s.half_height), 0)).norm() -
                   s.radius;
        case ShapeKind::cylinder:
            return std::max(across - s.radius, std::abs(p.y()) - s.half_height);
        case ShapeKind::cone: {
            const double slant = std::hypot(s.radius, 2 * s.half_height);
            const double side =
                (2 * s.half_height * across + s.radius * (p.y() - s.half_height)) / slant;
            return std::max(side, -s.half_height - p.y());
        }
        default: {
            double most = -kInfinity;
            const std::uint32_t* face = s.faces;
            for (std::uint32_t f = 0; f < s.face_count; ++f, face += *face + 1)
                most = std::max(most, v(s.face_normals[f]).dot(p - v(s.vertices[face[1]])));
            return most;
        }
    }
}

/// A polyhedron's normals and the directions of its edges, in the world.
struct Directions {
    std::vector<V> normals, edges;
};

Directions directions(const Shape& s, const Place& place) {
    Directions d;
    if (s.kind == ShapeKind::box) {
        for (int i = 0; i < 3; ++i) d.normals.push_back(place.q * V::Unit(i));
        d.edges = d.normals;
        return d;
    }
    const std::uint32_t* face = s.faces;
    for (std::uint32_t f = 0; f < s.face_count; ++f, face += *face + 1) {
        d.normals.push_back(place.q * v(s.face_normals[f]));
        for (std::uint32_t c = 0; c < *face; ++c) {
            const std::uint32_t i = face[1 + c], j = face[1 + (c + 1) % *face];
            if (i < j) d.edges.push_back(place.q * (v(s.vertices[j]) - v(s.vertices[i])));
        }
    }
    return d;
}

void offer(Widest& best, const V& n, double gap) {
    const bool elsewhere = best.n.dot(n) < 0.9998;
    if (gap > best.gap) {
        if (elsewhere) best.second = best.gap;
        best.gap = gap, best.n = n;
    } else if (elsewhere) {
        best.second = std::max(best.second, gap);
    }
}

/// Climbs from n to a local top of the support gap.
template <class Gap>
void climb(V& n, double& gap, const Gap& gap_of) {
    double step = 0.1;
    for (int round = 0; round < 150 && step > 1e-9; ++round) {
        const V u = n.unitOrthogonal(), w = n.cross(u);
        V better = n;
        double most = gap;
        for (int i = 0; i < 8; ++i) {
            const double angle = i * M_PI / 4;
            const V tried = (n + step * (std::cos(angle) * u + std::sin(angle) * w)).normalized();
            const double g = gap_of(tried);
            if (g > most) most = g, better = tried;
        }
        if (most > gap)
            gap = most, n = better;
        else
            step *= 0.4;
    }
}

}  // namespace

V support(const Shape& shape, const Place& place, const V& way) {
    return place.x + place.q * own_support(shape, place.q.conjugate() * way);
}

double support_gap(const Shape& a, const Place& pa, const Shape& b, const Place& pb, const V& n) {
    // The reach of a half-space along its own normal; along any other it has no end.
    const auto reach = [](const Shape& s, const Place& p, const V& d) {
        if (s.kind != ShapeKind::plane) return d.dot(support(s, p, d));
        const V up = p.q * V::UnitY();
        return d.dot(up) > 1 - 1e-9 ? d.dot(p.x) : kInfinity;
    };
    return -reach(a, pa, -n) - reach(b, pb, n);
}

double outside(const Shape& shape, const Place& place, const V& point) {
    return outside_own(shape, place.q.conjugate() * (point - place.x));
}

Widest separating_axes(const Shape& a, const Place& pa, const Shape& b, const Place& pb) {
    Widest best;
    const Directions da = directions(a, pa), db = directions(b, pb);
    const auto try_both = [&](const V& n) {
        offer(best, n, support_gap(a, pa, b, pb, n));
        offer(best, -n, support_gap(a, pa, b, pb, -n));
    };
    for (const V& n : da.normals) try_both(n);
    for (const V& n : db.normals) try_both(n);
    for (const V& e : da.edges)
        for (const V& f : db.edges) {
            const V n = e.cross(f);
            if (n.norm() > 1e-5 * e.norm() * f.norm()) try_both(n.normalized());
        }
    return best;
}

Widest widest_gap(const Shape& a, const Place& pa, const Shape& b, const Place& pb) {
    const auto gap_of = [&](const V& n) { return support_gap(a, pa, b, pb, n); };
    constexpr int kStarts = 150, kClimbs = 2;
    std::vector<std::pair<double, V>> starts;
    for (int i = 0; i < kStarts; ++i) {
        const double y = 1 - 2 * (i + 0.5) / kStarts, r = std::sqrt(1 - y * y);
        const double angle = 2.399963 * i;  // the golden angle spreads them evenly
        const V n(r * std::cos(angle), y, r * std::sin(angle));
        starts.emplace_back(gap_of(n), n);
    }
    for (const Place* p : {&pa, &pb})
        for (int i = 0; i < 6; ++i) {
            const V n = p->q * V::Unit(i % 3) * (i < 3 ? 1.0 : -1.0);
            starts.emplace_back(gap_of(n), n);
        }
    std::sort(starts.begin(), starts.end(),
              [](const auto& p, const auto& q) { return p.first > q.first; });
    Widest best;
    for (int i = 0; i < kClimbs; ++i) {
        auto [gap, n] = starts[static_cast<std::size_t>(i)];
        climb(n, gap, gap_of);
        offer(best, n, gap);
    }
    return best;
}

}  // namespace plumb::test
