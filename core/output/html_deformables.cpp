// SPDX-License-Identifier: MIT
#include "output/html_deformables.h"

#include "math/bytes.h"
#include "output/palette.h"
#include "output/smooth_surface.h"
#include "output/vector_json.h"
#include "scene/deformable_faults.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace plumb {
namespace {

using nlohmann::json;

/// Where triangles stand in the meshes, as a mesh without vertices of its own.
json put_triangles(std::string& meshes,
                   const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    json j{{"offset", meshes.size()}, {"vertices", 0}, {"triangles", triangles.size()}};
    for (const auto& triangle : triangles)
        for (const std::uint32_t corner : triangle) put(meshes, corner);
    return j;
}

/// Segments or triangles that some frames show, and which frames.
template <class Element>
struct Shown {
    std::vector<Element> elements;
    std::vector<std::array<std::size_t, 2>> frames;  ///< the first, and the one after the last
};

/// `in(frame)`: the elements of a frame. None that is gone comes back.
template <class In>
auto shown_in(const std::vector<Frame>& frames, In in) {
    using Element = typename decltype(in(frames[0]))::value_type;
    Shown<Element> shown;
    std::map<Element, std::size_t> known;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        if (f > 0 && frames[f].torn == frames[f - 1].torn) {
            for (auto& [first, last] : shown.frames) last += last == f;
            continue;
        }
        for (const Element& element : in(frames[f])) {
            const auto [at, is_new] = known.emplace(element, shown.elements.size());
            if (is_new) shown.elements.push_back(element), shown.frames.push_back({f, f});
            shown.frames[at->second][1] = f + 1;
        }
    }
    return shown;
}

bool tears_in(const std::vector<Frame>& frames, std::uint32_t deformable) {
    return std::any_of(frames.begin(), frames.end(), [&](const Frame& frame) {
        return std::any_of(frame.torn.begin(), frame.torn.end(),
                           [&](const auto& torn) { return torn[0] == deformable; });
    });
}

void put_segments(json& j, const RecordedDeformable& deformable, const std::vector<Frame>& frames) {
    j["segments"] = deformable.segments;
    if (!tears_in(frames, deformable.index)) return;
    const auto shown =
        shown_in(frames, [&](const Frame& frame) { return segments_in(deformable, frame); });
    j["segments"] = shown.elements, j["shown"] = shown.frames;
}

void put_surface(json& j, const RecordedDeformable& deformable, const std::vector<Frame>& frames,
                 std::string& meshes) {
    if (!tears_in(frames, deformable.index)) {
        j["mesh"] = put_triangles(meshes, deformable.triangles);
        return;
    }
    const auto shown =
        shown_in(frames, [&](const Frame& frame) { return triangles_in(deformable, frame); });
    j["mesh"] = put_triangles(meshes, shown.elements), j["shown"] = shown.frames;
}

json deformable_json(const RecordedDeformable& deformable, const std::vector<Frame>& frames,
                     const ParticleGrid& grid, std::string& meshes) {
    json j{{"name", deformable.name},
           {"kind", name_of(deformable.kind)},
           {"first", deformable.first},
           {"count", deformable.count},
           {"color", deformable_color(deformable, deformable.index)},
           {"low", to_json(grid.low)},
           {"quantum", grid.quantum}};
    if (!grid.bases.empty()) j["bases"] = grid.bases;
    if (deformable.kind == DeformableKind::rope) {
        j["radius"] = rope_radius(deformable);
        put_segments(j, deformable, frames);
    } else {
        j["crease"] = crease_cosine(deformable.kind);
        put_surface(j, deformable, frames, meshes);
    }
    return j;
}

json point_json(const RecordedPoint& point, const RecordingHeader& header) {
    if (point.particle != kNoIndex) return {{"particle", point.particle}};
    if (point.body < header.bodies.size())
        return {{"body", point.body}, {"place", to_json(point.place)}};
    return {{"place", to_json(point.place - header.origin)}};
}

}  // namespace

json deformables_json(const RecordingHeader& header, const std::vector<Frame>& frames,
                      const std::vector<ParticleGrid>& grids, std::string& meshes) {
    json list = json::array();
    for (std::size_t i = 0; i < grids.size(); ++i)
        list.push_back(deformable_json(header.deformables[i], frames, grids[i], meshes));
    return list;
}

json links_json(const RecordingHeader& header) {
    json list = json::array();
    for (const RecordedLink& link : header.links)
        list.push_back({point_json(link.a, header), point_json(link.b, header)});
    return list;
}

}  // namespace plumb
