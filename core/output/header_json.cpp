// SPDX-License-Identifier: MIT
#include "output/header_json.h"

#include <nlohmann/json.hpp>

#include <stdexcept>

namespace plumb {
namespace {

using nlohmann::json;

json to_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
json to_json(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

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
    return header;
}

}  // namespace plumb
