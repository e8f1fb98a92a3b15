// SPDX-License-Identifier: MIT
#include "output/html_deformables.h"

#include "math/bytes.h"
#include "output/palette.h"
#include "output/smooth_surface.h"
#include "scene/deformable_faults.h"

#include <nlohmann/json.hpp>

namespace plumb {
namespace {

using nlohmann::json;

json to_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Where triangles stand in the meshes, as a mesh without vertices of its own.
json put_triangles(std::string& meshes,
                   const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    json j{{"offset", meshes.size()}, {"vertices", 0}, {"triangles", triangles.size()}};
    for (const auto& triangle : triangles)
        for (const std::uint32_t corner : triangle) put(meshes, corner);
    return j;
}

json deformable_json(const RecordedDeformable& deformable, std::size_t index,
                     const ParticleGrid& grid, std::string& meshes) {
    json j{{"name", deformable.name},
           {"kind", name_of(deformable.kind)},
           {"first", deformable.first},
           {"count", deformable.count},
           {"color", deformable_color(deformable, index)},
           {"low", to_json(grid.low)},
           {"quantum", grid.quantum}};
    if (!grid.bases.empty()) j["bases"] = grid.bases;
    if (!deformable.rest.empty()) j["tearing_strain"] = deformable.tearing_strain;
    if (deformable.kind == DeformableKind::rope) {
        j["radius"] = rope_radius(deformable);
        j["segments"] = deformable.segments;
    } else {
        j["crease"] = crease_cosine(deformable.kind);
        j["mesh"] = put_triangles(meshes, deformable.triangles);
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

json deformables_json(const RecordingHeader& header, const std::vector<ParticleGrid>& grids,
                      std::string& meshes) {
    json list = json::array();
    for (std::size_t i = 0; i < grids.size(); ++i)
        list.push_back(deformable_json(header.deformables[i], i, grids[i], meshes));
    return list;
}

json links_json(const RecordingHeader& header) {
    json list = json::array();
    for (const RecordedLink& link : header.links)
        list.push_back({point_json(link.a, header), point_json(link.b, header)});
    return list;
}

}  // namespace plumb
