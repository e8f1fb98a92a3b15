// SPDX-License-Identifier: MIT
#include "host/shape_pairs.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace plumb {
namespace {

/// Bodies that the pairs of kinds cannot tell apart: one stands for all.
struct Class {
    ShapeKind kind;
    Motion motion;
    std::uint32_t group, mask;
    auto key() const { return std::tuple(kind, motion, group, mask); }
    bool operator<(const Class& o) const { return key() < o.key(); }
};

void add_kinds(const Geometry& g, std::vector<ShapeKind>& kinds) {
    if (g.kind != ShapeKind::compound) {
        kinds.push_back(g.kind);
        return;
    }
    for (const GeometryPart& p : g.parts) add_kinds(p.geometry, kinds);
}

bool is_mesh(ShapeKind k) { return k == ShapeKind::mesh || k == ShapeKind::height_field; }

}  // namespace

std::vector<ShapePairNeed> shape_pair_needs(const Scene& scene) {
    std::map<Class, std::pair<std::string, int>> classes;  // an example, and how many bodies
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const BodySpec& b = scene.bodies[i];
        if (b.geometry == kNoIndex) continue;
        std::vector<ShapeKind> kinds;
        add_kinds(scene.geometries[b.geometry], kinds);
        std::sort(kinds.begin(), kinds.end());
        kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
        for (ShapeKind kind : kinds) {
            auto& entry = classes[{kind, b.motion, b.group, b.mask}];
            if (entry.second++ == 0)
                entry.first =
                    b.name.empty() ? "body " + std::to_string(i) : "body \"" + b.name + "\"";
        }
    }

    std::map<std::tuple<ShapeKind, ShapeKind, bool>, std::string> needs;
    for (const auto& [x, about_x] : classes)
        for (const auto& [y, about_y] : classes) {
            if (y < x) continue;
            const bool same = !(x < y);
            if (same && about_x.second < 2) continue;
            if (x.motion != Motion::dynamic && y.motion != Motion::dynamic) continue;
            if (!(x.group & y.mask) || !(y.group & x.mask)) continue;
            const bool moving = (is_mesh(x.kind) && x.motion != Motion::fixed) ||
                                (is_mesh(y.kind) && y.motion != Motion::fixed);
            needs.try_emplace({std::min(x.kind, y.kind), std::max(x.kind, y.kind), moving},
                              about_x.first + " and " + (same ? "another" : about_y.first));
        }
    std::vector<ShapePairNeed> result;
    for (const auto& [key, example] : needs)
        result.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), example});
    return result;
}

}  // namespace plumb
