// SPDX-License-Identifier: MIT
#include "output/header_json.h"

#include "output/vector_json.h"

#include <nlohmann/json.hpp>

#include <stdexcept>

namespace plumb {
namespace {

using nlohmann::json;

/// JSON has no infinities: a number that was none comes back as 0.
double number(const json& j) { return j.is_number() ? j.get<double>() : 0; }

Eigen::Vector3d vector(const json& j) {
    return {number(j.at(0)), number(j.at(1)), number(j.at(2))};
}
Eigen::Quaterniond quaternion(const json& j) {
    return {number(j.at(3)), number(j.at(0)), number(j.at(1)), number(j.at(2))};
}

/// Three numbers a vertex, in one flat list.
json flat(const std::vector<Eigen::Vector3d>& vertices) {
    json list = json::array();
    for (const Eigen::Vector3d& v : vertices) {
        for (int i = 0; i < 3; ++i) list.push_back(v[i]);
    }
    return list;
}

std::vector<Eigen::Vector3d> unflat(const json& list) {
    std::vector<Eigen::Vector3d> vertices;
    for (std::size_t i = 0; i + 2 < list.size(); i += 3) {
        vertices.emplace_back(number(list[i]), number(list[i + 1]), number(list[i + 2]));
    }
    return vertices;
}

json geometry_to_json(const Geometry& g) {
    json j{{"name", g.name}, {"kind", static_cast<std::uint32_t>(g.kind)}};
    j["half_extents"] = to_json(g.half_extents);
    j["radius"] = g.radius;
    j["half_height"] = g.half_height;
    j["vertices"] = flat(g.vertices);
    j["faces"] = g.faces;
    j["triangles"] = g.triangles;
    j["heights"] = g.heights;
    j["rows"] = g.rows;
    j["columns"] = g.columns;
    j["spacing"] = {g.spacing_x, g.spacing_z};
    j["parts"] = json::array();
    for (const GeometryPart& part : g.parts) {
        j["parts"].push_back({{"geometry", geometry_to_json(part.geometry)},
                              {"position", to_json(part.local.position)},
                              {"rotation", to_json(part.local.rotation)}});
    }
    return j;
}

Geometry geometry_from_json(const json& j) {
    Geometry g;
    g.name = j.at("name");
    const auto kind = j.at("kind").get<std::uint32_t>();
    if (kind >= kShapeKindCount) throw std::runtime_error("unknown kind of shape");
    g.kind = static_cast<ShapeKind>(kind);
    g.half_extents = vector(j.at("half_extents"));
    g.radius = number(j.at("radius"));
    g.half_height = number(j.at("half_height"));
    g.vertices = unflat(j.at("vertices"));
    j.at("faces").get_to(g.faces);
    j.at("triangles").get_to(g.triangles);
    for (const json& height : j.at("heights")) g.heights.push_back(number(height));
    g.rows = j.at("rows");
    g.columns = j.at("columns");
    g.spacing_x = number(j.at("spacing").at(0));
    g.spacing_z = number(j.at("spacing").at(1));
    for (const json& part : j.at("parts")) {
        g.parts.push_back({geometry_from_json(part.at("geometry")),
                           {vector(part.at("position")), quaternion(part.at("rotation"))}});
    }
    return g;
}

json body_to_json(const RecordedBody& body) {
    return {{"name", body.name},
            {"geometry", body.geometry},
            {"motion", static_cast<std::uint32_t>(body.motion)},
            {"color", body.color}};
}

RecordedBody body_from_json(const json& j) {
    const auto motion = j.at("motion").get<std::uint32_t>();
    if (motion > static_cast<std::uint32_t>(Motion::dynamic)) {
        throw std::runtime_error("unknown kind of motion");
    }
    return {j.at("name"), j.at("geometry"), static_cast<Motion>(motion), j.at("color")};
}

json deformable_to_json(const RecordedDeformable& d) {
    json j{{"name", d.name},           {"kind", static_cast<std::uint32_t>(d.kind)},
           {"count", d.count},         {"segments", d.segments},
           {"triangles", d.triangles}, {"thickness", d.thickness},
           {"radius", d.radius},       {"size", d.size},
           {"color", d.color}};
    if (d.tears) j["tears"] = true, j["tetrahedra"] = d.tetrahedra;
    return j;
}

template <std::size_t N>
void take_elements(const json& j, std::vector<std::array<std::uint32_t, N>>& elements,
                   std::uint32_t points) {
    j.get_to(elements);
    for (const auto& element : elements)
        for (const std::uint32_t point : element)
            if (point >= points) throw std::runtime_error("a deformable names a point it lacks");
}

/// `first`: number of particles of those before it.
RecordedDeformable deformable_from_json(const json& j, std::uint32_t first) {
    RecordedDeformable d;
    d.name = j.at("name");
    const auto kind = j.at("kind").get<std::uint32_t>();
    if (kind > static_cast<std::uint32_t>(DeformableKind::solid))
        throw std::runtime_error("unknown kind of deformable");
    d.kind = static_cast<DeformableKind>(kind);
    d.first = first;
    d.count = j.at("count");
    take_elements(j.at("segments"), d.segments, d.count);
    take_elements(j.at("triangles"), d.triangles, d.count);
    d.thickness = number(j.at("thickness"));
    d.radius = number(j.at("radius"));
    d.size = number(j.at("size"));
    d.color = j.at("color");
    d.tears = j.contains("tears");
    if (d.tears) take_elements(j.at("tetrahedra"), d.tetrahedra, d.count);
    return d;
}

json point_to_json(const RecordedPoint& point) {
    return {{"particle", point.particle}, {"body", point.body}, {"place", to_json(point.place)}};
}

RecordedPoint point_from_json(const json& j) {
    return {j.at("particle"), j.at("body"), vector(j.at("place"))};
}

/// Versions before deformables have no such keys.
void take_deformables(const json& j, RecordingHeader& header) {
    if (!j.contains("deformables")) return;
    std::uint32_t first = 0;
    for (const json& d : j.at("deformables")) {
        header.deformables.push_back(deformable_from_json(d, first));
        header.deformables.back().index = static_cast<std::uint32_t>(header.deformables.size()) - 1;
        const std::uint32_t count = header.deformables.back().count;
        if (count > kNoIndex - first) throw std::runtime_error("there are too many particles");
        first += count;
    }
    for (const json& link : j.at("links"))
        header.links.push_back({point_from_json(link.at("a")), point_from_json(link.at("b"))});
}

void put_deformables(json& j, const RecordingHeader& header) {
    if (header.deformables.empty() && header.links.empty()) return;
    j["deformables"] = j["links"] = json::array();
    for (const RecordedDeformable& d : header.deformables)
        j["deformables"].push_back(deformable_to_json(d));
    for (const RecordedLink& link : header.links)
        j["links"].push_back({{"a", point_to_json(link.a)}, {"b", point_to_json(link.b)}});
}

json view_to_json(const View& view) {
    return {{"eye", to_json(view.eye)},
            {"target", to_json(view.target)},
            {"field_of_view", view.field_of_view}};
}

View view_from_json(const json& j) {
    return {vector(j.at("eye")), vector(j.at("target")), number(j.at("field_of_view"))};
}

}  // namespace

std::string header_to_json(const RecordingHeader& header) {
    json j{{"name", header.name}, {"description", header.description}, {"method", header.method}};
    j["dt"] = header.dt;
    j["gravity"] = to_json(header.gravity);
    j["origin"] = to_json(header.origin);
    j["collider"] = header.metadata.collider;
    j["metadata"] = header.metadata.values;
    if (header.view) j["view"] = view_to_json(*header.view);
    j["geometries"] = json::array();
    for (const Geometry& g : header.geometries) j["geometries"].push_back(geometry_to_json(g));
    j["bodies"] = json::array();
    for (const RecordedBody& body : header.bodies) j["bodies"].push_back(body_to_json(body));
    put_deformables(j, header);
    if (header.residuals)
        j["residual"] = {{"force_of_weight", "1"}, {"force", "N"}, {"error", "m"}};
    return j.dump(-1, ' ', false, json::error_handler_t::replace);
}

RecordingHeader header_from_json(std::string_view text) {
    const json j = json::parse(text);
    RecordingHeader header;
    header.name = j.at("name");
    header.description = j.at("description");
    header.method = j.at("method");
    header.dt = number(j.at("dt"));
    header.gravity = vector(j.at("gravity"));
    header.origin = vector(j.at("origin"));
    header.metadata.collider = j.at("collider");
    j.at("metadata").get_to(header.metadata.values);
    if (j.contains("view")) header.view = view_from_json(j.at("view"));
    for (const json& g : j.at("geometries")) header.geometries.push_back(geometry_from_json(g));
    for (const json& body : j.at("bodies")) header.bodies.push_back(body_from_json(body));
    take_deformables(j, header);
    header.residuals = j.contains("residual");
    return header;
}

}  // namespace plumb
