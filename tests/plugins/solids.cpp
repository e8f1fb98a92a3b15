// SPDX-License-Identifier: MIT
#include "solids.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

constexpr int kSamples = 120;  ///< along an edge of a face, or around an axis

void sample_triangle(std::vector<V>& out, const V& a, const V& b, const V& c, int n) {
    for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j)
            out.push_back(a + (b - a) * (double(i) / n) + (c - a) * (double(j) / n));
}

/// A surface of revolution about y: the outline (r, y) turned.
std::vector<V> turned(const std::vector<std::pair<double, double>>& outline) {
    std::vector<V> points;
    for (std::size_t s = 0; s + 1 < outline.size(); ++s)
        for (int i = 0; i <= kSamples; ++i) {
            const double t = double(i) / kSamples;
            const double r = outline[s].first + t * (outline[s + 1].first - outline[s].first);
            const double y = outline[s].second + t * (outline[s + 1].second - outline[s].second);
            for (int k = 0; k < kSamples; ++k) {
                const double angle = 2 * M_PI * k / kSamples;
                points.push_back({r * std::cos(angle), y, r * std::sin(angle)});
            }
        }
    return points;
}

/// The outline of a capsule, or of a ball where h is 0.
std::vector<std::pair<double, double>> pill(double r, double h) {
    std::vector<std::pair<double, double>> outline;
    for (int i = 0; i <= 40; ++i) {
        const double angle = M_PI * i / 40;
        if (i == 20) outline.push_back({r, h});
        outline.push_back({r * std::sin(angle), (i < 20 ? h : -h) + r * std::cos(angle)});
    }
    return outline;
}

/// Faces of a hull or a mesh.
std::vector<V> faces_of(const Shape& s, int n) {
    std::vector<V> points;
    const std::uint32_t* at = s.faces;
    for (std::uint32_t f = 0; f < s.face_count; ++f) {
        const std::uint32_t corners = s.kind == ShapeKind::mesh ? 3 : *at++;
        for (std::uint32_t i = 2; i < corners; ++i)
            sample_triangle(points, v(s.vertices[at[0]]), v(s.vertices[at[i - 1]]),
                            v(s.vertices[at[i]]), n);
        at += corners;
    }
    return points;
}

bool inside_hull(const Shape& s, const V& p) {
    const std::uint32_t* at = s.faces;
    for (std::uint32_t f = 0; f < s.face_count; ++f) {
        if (v(s.face_normals[f]).dot(p - v(s.vertices[at[1]])) >= 0) return false;
        at += *at + 1;
    }
    return true;
}

}  // namespace

double winding(const Shape& mesh, const V& p) {
    // The sum of the triangles' solid angles (van Oosterom and Strackee).
    double sum = 0;
    for (std::uint32_t t = 0; t < mesh.face_count; ++t) {
        const std::uint32_t* k = mesh.faces + 3 * t;
        const V a = v(mesh.vertices[k[0]]) - p, b = v(mesh.vertices[k[1]]) - p,
                c = v(mesh.vertices[k[2]]) - p;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        sum += 2 * std::atan2(a.dot(b.cross(c)),
                              la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum / (4 * M_PI);
}

std::vector<Solid> solids_of(const std::string& plugin) {
    const auto radial = [](const V& p) { return std::hypot(p.x(), p.z()); };
    const Shape cuboid = box_hull(.5, .3, .2), gem = octahedron(.5);
    const Shape ring = torus_mesh(.5, .2, 32, 16);
    std::vector<Solid> all = {
        {"sphere", sphere(.4), [](const V& p) { return p.norm() < .4; }, turned(pill(.4, 0)), .03},
        {"box", box(.5, .3, .2),
         [](const V& p) {
             return std::abs(p.x()) < .5 && std::abs(p.y()) < .3 && std::abs(p.z()) < .2;
         },
         faces_of(cuboid, kSamples), .02},
        {"capsule", capsule(.2, .4),
         [](const V& p) { return (p - V(0, std::clamp(p.y(), -.4, .4), 0)).norm() < .2; },
         turned(pill(.2, .4)), .02},
        {"cylinder", cylinder(.3, .4),
         [=](const V& p) { return radial(p) < .3 && std::abs(p.y()) < .4; },
         turned({{0, .4}, {.3, .4}, {.3, -.4}, {0, -.4}}), .03},
        {"cone", cone(.3, .4),
         [=](const V& p) { return p.y() > -.4 && radial(p) < .3 * (.4 - p.y()) / .8; },
         turned({{0, .4}, {.3, -.4}, {0, -.4}}), .03},
        {"hull", gem, [gem](const V& p) { return inside_hull(gem, p); }, faces_of(gem, kSamples),
         .02},
        {"torus", ring, [ring](const V& p) { return winding(ring, p) > .5; }, faces_of(ring, 6),
         .03},
    };
    std::erase_if(all, [&](const Solid& s) { return !takes(plugin, s.shape.kind); });
    return all;
}

}  // namespace plumb::test
