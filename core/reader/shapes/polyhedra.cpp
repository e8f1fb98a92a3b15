// SPDX-License-Identifier: MIT
#include "reader/shapes/polyhedra.h"

#include "geometry/bad_shape.h"
#include "geometry/hills.h"
#include "geometry/hull.h"
#include "reader/json/lists.h"
#include "reader/meshes/obj.h"
#include "reader/shapes/height_fields.h"
#include "reader/shapes/read_decompose.h"

namespace plumb::reader {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Points from the scene itself or from a file.
struct PointsDraft {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<Triangle> triangles;
    std::string obj;
    double scale = 1;
    std::optional<DecomposeOptions> decompose;
};

const Table<PointsDraft>& hull_table() {
    using P = PointsDraft;
    static const Table<P> table = {
        field<P>("vertices", PointList{}, &P::vertices, "points, whose convex hull is taken [m]"),
        field<P>("obj", Text{}, &P::obj, "Wavefront OBJ file, relative to the scene's folder"),
        field<P>("scale", Number{kScale}, &P::scale, "factor on the coordinates of the file"),
    };
    return table;
}

const Table<PointsDraft>& mesh_table() {
    static const Table<PointsDraft> table = [] {
        Table<PointsDraft> fields = hull_table();
        fields[0].meaning = "corners of the triangles [m]";
        fields.push_back(field<PointsDraft>(
            "triangles", IndexList<3>{"triangles [i, j, k]", "vertices"}, &PointsDraft::triangles,
            "three indices of vertices each, counter-clockwise from outside"));
        fields.push_back(special<PointsDraft>(
            "height_field", height_field_schema(),
            [](PointsDraft& p, const Node& node) {
                ShapeDraft field{nullptr, {}};
                read_height_field(field, node);
                Geometry mesh = mesh_of_height_field(field.geometry);
                p.vertices = std::move(mesh.vertices);
                p.triangles = std::move(mesh.triangles);
            },
            "a height field, whose surface becomes the mesh"));
        fields.push_back(special<PointsDraft>(
            "decompose", decompose_schema(),
            [](PointsDraft& p, const Node& node) {
                DecomposeOptions options;
                read_decompose(options, node);
                if (node.json() != false) p.decompose = options;
            },
            "turn the mesh, which must be closed, into a compound of convex hulls"));
        return fields;
    }();
    return table;
}

/// Calls `make` and lets what it throws name the node.
template <class Make>
auto at_node(const Node& node, Make make) {
    try {
        return make();
    } catch (const BadShape& error) {
        node.fail(error.what());
    }
}

std::vector<Eigen::Vector3d> scaled(std::vector<Eigen::Vector3d> points, double scale,
                                    const Node& node) {
    for (Eigen::Vector3d& p : points) {
        p *= scale;
        if (!(p.cwiseAbs().maxCoeff() <= 1e6))
            node.fail("a vertex of the file lies further away than 1e6 m");
    }
    return points;
}

void require_one_source(const Node& node) {
    node.require_one("vertices", "obj");
    node.require_beside("scale", "obj");
}

void check_triangles(const PointsDraft& draft, const Node& node) {
    if (!node.has("triangles")) node.fail("\"triangles\" is missing");
    if (draft.triangles.empty()) node.at("triangles").fail("a mesh needs at least one triangle");
    for (std::size_t i = 0; i < draft.triangles.size(); ++i) {
        const auto& [a, b, c] = draft.triangles[i];
        const Node place = node.at("triangles").at(i);
        if (std::max({a, b, c}) >= draft.vertices.size()) {
            place.fail("the mesh has " + std::to_string(draft.vertices.size()) +
                       " vertices, numbered from 0; the triangle names one that is not there");
        }
        const Eigen::Vector3d u = draft.vertices[b] - draft.vertices[a],
                              v = draft.vertices[c] - draft.vertices[a];
        if (!(u.cross(v).norm() > 0)) place.fail("the triangle has no area");
    }
}

SchemaJson either_source(SchemaJson json, const SchemaJson& inline_keys) {
    json["oneOf"] = {{{"required", inline_keys}}, {{"required", {"obj"}}}};
    return json;
}

}  // namespace

Geometry hull_geometry(const std::vector<Eigen::Vector3d>& points) {
    Hull hull = convex_hull(points);
    Geometry geometry;
    geometry.kind = ShapeKind::hull;
    geometry.vertices = std::move(hull.vertices);
    geometry.faces = std::move(hull.faces);
    return geometry;
}

void read_hull(ShapeDraft& draft, const Node& node) {
    PointsDraft points;
    read_object(points, node, hull_table());
    require_one_source(node);
    if (points.obj.empty()) {
        draft.geometry = at_node(node, [&] { return hull_geometry(points.vertices); });
        return;
    }
    draft.geometry = at_node(node.at("obj"), [&] {
        const TriangleMesh mesh = load_obj(node.source().folder / points.obj);
        return hull_geometry(scaled(mesh.vertices, points.scale, node.at("obj")));
    });
}

void read_mesh(ShapeDraft& draft, const Node& node) {
    PointsDraft points;
    read_object(points, node, mesh_table());
    if (node.has("height_field")) {
        if (node.size() > 1)
            node.fail(
                "a mesh of a height field has no other source, and is open, so it cannot be "
                "decomposed");
    } else if (require_one_source(node); points.obj.empty()) {
        check_triangles(points, node);
    } else {
        if (node.has("triangles"))
            node.at("triangles").fail("\"triangles\" go with \"vertices\", not with \"obj\"");
        TriangleMesh mesh =
            at_node(node.at("obj"), [&] { return load_obj(node.source().folder / points.obj); });
        points.vertices = scaled(std::move(mesh.vertices), points.scale, node.at("obj"));
        points.triangles = std::move(mesh.triangles);
    }
    draft.geometry.kind = ShapeKind::mesh;
    draft.geometry.vertices = std::move(points.vertices);
    draft.geometry.triangles = std::move(points.triangles);
    if (points.decompose) {
        draft.geometry = at_node(node.at("decompose"),
                                 [&] { return decomposed(draft.geometry, *points.decompose); });
    }
}

std::vector<GeometryPart> hulls_of_file(const Node& node, double scale) {
    const std::string name = Text{}.read(node);
    const auto meshes = at_node(node, [&] { return load_obj_groups(node.source().folder / name); });
    std::vector<GeometryPart> parts;
    for (const TriangleMesh& mesh : meshes) {
        try {
            parts.push_back({hull_geometry(scaled(mesh.vertices, scale, node)), {}});
        } catch (const BadShape& error) {
            node.fail("object \"" + mesh.name + "\" of the file: " + error.what());
        }
        parts.back().geometry.name = mesh.name;
    }
    return parts;
}

SchemaJson hull_schema() { return either_source(object_schema(hull_table()), {"vertices"}); }

SchemaJson mesh_schema() {
    SchemaJson json = either_source(object_schema(mesh_table()), {"vertices", "triangles"});
    json["oneOf"].push_back({{"required", {"height_field"}}});
    return json;
}

}  // namespace plumb::reader
