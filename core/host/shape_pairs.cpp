// SPDX-License-Identifier: MIT
#include "host/shape_pairs.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace plumb {
namespace {

constexpr double kNeighbours = 6;  ///< of a part in a heap, without the surface it stands on

/// Bodies that the pairs of kinds cannot tell apart: one stands for all.
struct Class {
    ShapeKind kind;
    Motion motion;
    std::uint32_t group, mask;
    auto key() const { return std::tuple(kind, motion, group, mask); }
    bool operator<(const Class& o) const { return key() < o.key(); }
    bool operator==(const Class& o) const { return key() == o.key(); }
};

/// What belongs to a class.
struct Members {
    std::string example;
    double bodies = 0, parts = 0;
};
using Classes = std::map<Class, Members>;
using Entry = Classes::value_type;

void add_kinds(const Geometry& g, std::map<ShapeKind, double>& parts) {
    if (g.kind == ShapeKind::compound)
        for (const GeometryPart& p : g.parts) add_kinds(p.geometry, parts);
    else
        ++parts[g.kind];
}

Classes classes_of(const Scene& scene) {
    Classes classes;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const BodySpec& b = scene.bodies[i];
        if (b.geometry == kNoIndex) continue;
        std::map<ShapeKind, double> parts;
        add_kinds(scene.geometries[b.geometry], parts);
        for (const auto& [kind, count] : parts) {
            Members& members = classes[{kind, b.motion, b.group, b.mask}];
            if (members.bodies++ == 0)
                members.example =
                    b.name.empty() ? "body " + std::to_string(i) : "body \"" + b.name + "\"";
            members.parts += count;
        }
    }
    return classes;
}

bool is_mesh(ShapeKind k) { return k == ShapeKind::mesh || k == ShapeKind::height_field; }
bool is_surface(ShapeKind k) { return k == ShapeKind::plane || is_mesh(k); }

/// How many parts of y one part of x may meet.
double partners(const Entry& x, const Entry& y) {
    if (x.first.motion != Motion::dynamic && y.first.motion != Motion::dynamic) return 0;
    if (!(x.first.group & y.first.mask) || !(y.first.group & x.first.mask)) return 0;
    const Members& m = y.second;
    return x.first == y.first ? m.parts * (m.bodies - 1) / m.bodies : m.parts;
}

/// How many parts of y are near one part of x, which is dynamic.
double neighbours(const Classes& classes, const Entry& x, const Entry& y) {
    const bool surface = is_surface(y.first.kind);
    double all = 0;  // that stand beside y to be drawn from
    for (const Entry& z : classes)
        if (is_surface(z.first.kind) == surface) all += partners(x, z);
    const double wanted = surface ? 1 : kNeighbours;
    return partners(x, y) * std::min(1.0, wanted / all);
}

/// How many pairs of parts of two classes that may meet are near each other, the mean of what both
/// sides make of it.
double near_pairs(const Classes& classes, const Entry& x, const Entry& y) {
    double sum = 0, sides = 0;
    for (const auto& [p, q] : {std::pair(&x, &y), std::pair(&y, &x)}) {
        if (p->first.motion != Motion::dynamic) continue;
        sum += p->second.parts * neighbours(classes, *p, *q);
        sides += 1;
    }
    return sum / sides / (x.first == y.first ? 2 : 1);
}

}  // namespace

std::vector<ShapePairNeed> shape_pair_needs(const Scene& scene) {
    const Classes classes = classes_of(scene);
    std::map<std::tuple<ShapeKind, ShapeKind, bool>, ShapePairNeed> needs;
    for (const Entry& x : classes)
        for (const Entry& y : classes) {
            if (y.first < x.first || partners(x, y) == 0) continue;
            const bool moving = (is_mesh(x.first.kind) && x.first.motion != Motion::fixed) ||
                                (is_mesh(y.first.kind) && y.first.motion != Motion::fixed);
            const auto [a, b] = std::minmax(x.first.kind, y.first.kind);
            const std::string other = x.first == y.first ? "another" : y.second.example;
            const ShapePairNeed fresh{a, b, moving, 0, x.second.example + " and " + other};
            needs.try_emplace({a, b, moving}, fresh).first->second.near +=
                near_pairs(classes, x, y);
        }
    std::vector<ShapePairNeed> result;
    for (const auto& [key, need] : needs) result.push_back(need);
    return result;
}

bool supports(const PluginTable& table, const ShapePairNeed& need) {
    const std::uint32_t ability =
        table.pairs[static_cast<std::size_t>(need.a)][static_cast<std::size_t>(need.b)];
    if (need.moving_mesh && !(ability & kPairMovingMesh)) return false;
    return (ability & (kPairPoint | kPairManifold)) != 0;
}

}  // namespace plumb
