// SPDX-License-Identifier: MIT
/// Keys of the shapes of deformables: an object with exactly one key, which names the shape.
#include "reader/deformables/deformable_shapes.h"

#include <algorithm>
#include <cmath>

#include "geometry/bad_shape.h"
#include "reader/deformables/deformables.h"
#include "reader/json/lists.h"
#include "reader/shapes/polyhedra.h"
#include "scene/deformable_faults.h"

namespace plumb::reader {

namespace {

using Draft = DeformableDraft;
constexpr Range kCells{1, 1e4}, kCellsAround{3, 1e4}, kCellsOfBall{1, 1e3};

void take(Draft& draft, Elements elements) {
    draft.spec.points = std::move(elements.points);
    draft.spec.segments = std::move(elements.segments);
    draft.spec.triangles = std::move(elements.triangles);
    draft.spec.tetrahedra = std::move(elements.tetrahedra);
}

struct GridKeys {
    std::array<std::uint32_t, 2> cells{20, 20};
    std::array<double, 2> size{1, 1};
};

const Table<GridKeys>& grid_keys() {
    using G = GridKeys;
    static const Table<G> table = {
        field<G>(
            "cells", WholeList<2>{kCells}, &G::cells,
            "along x and z; [20, 20] is the default; points run along x first, from the corner "
            "where both are least"),
        field<G>("size", NumberList<2>{kLength}, &G::size, "along x and z [m]", Presence::required),
    };
    return table;
}

void read_grid(Draft& draft, const Node& node) {
    GridKeys grid;
    read_object(grid, node, grid_keys());
    require_room(*draft.scene, (grid.cells[0] + 1.0) * (grid.cells[1] + 1.0), node);
    take(draft, grid_surface(grid.cells, {grid.size[0], grid.size[1]}));
}

struct BallKeys {
    double radius = 0;
    std::uint32_t cells = 8;
};

const Table<BallKeys>& ball_table() {
    using B = BallKeys;
    static const Table<B> table = {
        field<B>("radius", Number{kLength}, &B::radius, "[m]", Presence::required),
        field<B>("cells", Whole<std::uint32_t>{kCellsOfBall}, &B::cells,
                 "along each edge of the icosahedron that becomes the sphere, which then has "
                 "10 cells² + 2 points; 8 is the default"),
    };
    return table;
}

void read_ball(Draft& draft, const Node& node) {
    BallKeys ball;
    read_object(ball, node, ball_table());
    const bool solid = draft.spec.kind == DeformableKind::solid;
    require_room(*draft.scene,
                 static_cast<double>(solid ? ball_solid_points(ball.cells)
                                           : ball_surface_points(ball.cells)),
                 node);
    take(draft,
         solid ? ball_solid(ball.radius, ball.cells) : ball_surface(ball.radius, ball.cells));
}

struct TubeKeys {
    double radius = 0, length = 0;
    std::array<std::uint32_t, 2> cells{24, 24};
};

const Table<TubeKeys>& tube_table() {
    using T = TubeKeys;
    static const Table<T> table = {
        field<T>("radius", Number{kLength}, &T::radius, "[m]", Presence::required),
        field<T>("length", Number{kLength}, &T::length, "along y [m]", Presence::required),
        special<T>(
            "cells",
            {{"type", "array"},
             {"prefixItems",
              {Whole<std::uint32_t>{kCellsAround}.schema(), Whole<std::uint32_t>{kCells}.schema()}},
             {"minItems", 2},
             {"maxItems", 2}},
            [](T& t, const Node& node) {
                t.cells = WholeList<2>{kCells}.read(node);
                t.cells[0] = Whole<std::uint32_t>{kCellsAround}.read(node.at(0));
            },
            "around and along; [24, 24] is the default; points run around first, from the lower "
            "end"),
    };
    return table;
}

void read_tube(Draft& draft, const Node& node) {
    TubeKeys tube;
    read_object(tube, node, tube_table());
    const bool closed = draft.spec.kind == DeformableKind::balloon;
    const double around = tube.cells[0], lids = closed ? around * around / 6 + 2 : 0;
    require_room(*draft.scene, around * (tube.cells[1] + 1.0) + lids, node);
    take(draft, tube_surface(tube.radius, tube.length, tube.cells, closed));
}

struct LatticeKeys {
    std::optional<Eigen::Vector3d> half_extents;
    std::array<std::uint32_t, 3> cells{8, 8, 8};
    std::string mesh;
    double cell = 0, scale = 1;
    CellCut tetrahedra = CellCut::five;
};

const Table<LatticeKeys>& lattice_table() {
    using L = LatticeKeys;
    static const Table<L> table = {
        field<L>("half_extents", Vector3{kLength}, &L::half_extents,
                 "of a box about the origin, half the length of each edge [m]"),
        special<L>(
            "size", Vector3{kLength}.schema(),
            [](L& l, const Node& n) { l.half_extents = Vector3{kLength}.read(n) / 2; },
            "length of each edge [m], in place of half_extents"),
        field<L>(
            "cells", WholeList<3>{kCells}, &L::cells,
            "of the box along x, y and z; [8, 8, 8] is the default; corners of cells run along "
            "x first, then z, then y; centres follow where they are points"),
        field<L>("mesh", Text{}, &L::mesh,
                 "in place of a box: a closed mesh, an OBJ file relative to the scene's folder; "
                 "the solid is made of the cells whose centres lie inside"),
        field<L>("cell", Number{kLength}, &L::cell, "edge of a cell in the mesh [m]"),
        field<L>("scale", Number{kScale}, &L::scale, "factor on the coordinates of the mesh"),
        field<L>(
            "tetrahedra",
            Choice<CellCut>{{{"five", CellCut::five}, {"body_centered", CellCut::body_centered}}},
            &L::tetrahedra,
            "of a cell: five, the default, or a body-centred lattice around the centres of "
            "cells, with twice as many points and 0.6 of the error of bending"),
    };
    return table;
}

/// Each key stands where its like does: a box has "cells", a mesh a "cell".
void check_lattice(const Node& node) {
    const int shapes = node.has("half_extents") + node.has("size") + node.has("mesh");
    if (shapes != 1) node.fail("must have one of \"half_extents\", \"size\" and \"mesh\"");
    if (node.has("mesh") && !node.has("cell"))
        node.fail("\"cell\" is missing, the edge of a cell in the mesh");
    if (node.has("mesh") && node.has("cells"))
        node.at("cells").fail("\"cells\" are of a box; a mesh has a \"cell\", its edge");
    for (const char* key : {"cell", "scale"}) node.require_beside(key, "mesh");
}

void read_lattice(Draft& draft, const Node& node) {
    LatticeKeys lattice;
    read_object(lattice, node, lattice_table());
    check_lattice(node);
    if (lattice.half_extents) {
        const auto& c = lattice.cells;
        const auto points = box_lattice_points({c[0], c[1], c[2]}, lattice.tetrahedra);
        require_room(*draft.scene, static_cast<double>(points), node);
        take(draft, box_lattice(*lattice.half_extents, c, lattice.tetrahedra));
        return;
    }
    const FileElements file =
        read_elements_file(node.at("mesh"), lattice.scale, DeformableKind::cloth);
    try {
        take(draft, mesh_lattice({"", file.elements.points, file.elements.triangles}, lattice.cell,
                                 lattice.tetrahedra));
    } catch (const BadShape& error) {
        node.fail(error.what());
    }
    require_room(*draft.scene, static_cast<double>(draft.spec.points.size()), node);
}

struct LineKeys {
    Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();
    std::uint32_t segments = 20;
};

const Table<LineKeys>& line_table() {
    using L = LineKeys;
    static const Table<L> table = {
        field<L>("from", Vector3{kCoordinate}, &L::from, "of the first point [m]",
                 Presence::required),
        field<L>("to", Vector3{kCoordinate}, &L::to, "of the last point [m]", Presence::required),
        field<L>("segments", Whole<std::uint32_t>{{1, 1e6}}, &L::segments,
                 "20 is the default; the points are one more"),
    };
    return table;
}

void read_line(Draft& draft, const Node& node) {
    LineKeys line;
    read_object(line, node, line_table());
    if (line.from == line.to)
        node.fail("the line has no length: \"from\" and \"to\" are one point");
    require_room(*draft.scene, line.segments + 1.0, node);
    take(draft, straight_line(line.from, line.to, line.segments));
}

struct MeshKeys {
    Elements elements;
    std::string file;
    double scale = 1;
};

const Table<MeshKeys>& mesh_table() {
    using M = MeshKeys;
    static const Table<M> table = {
        field<M>(
            "file", Text{}, &M::file,
            "of triangles, OBJ, or of triangles or tetrahedra, Gmsh's .msh (2.2 or 4.1, "
            "ASCII) or TetGen's .node with its .ele beside it; relative to the scene's folder; "
            "points of a file that lie at one place become one"),
        field<M>("scale", Number{kScale}, &M::scale, "factor on the coordinates of the file"),
        field<M>(
            "points", PointList{}, [](M & m) -> auto& { return m.elements.points; },
            "in place of a file [m]"),
        field<M>(
            "segments", IndexList<2>{"segments [i, j]", "points"},
            [](M & m) -> auto& { return m.elements.segments; }, "of a rope, by its points"),
        field<M>(
            "triangles", IndexList<3>{"triangles [i, j, k]", "points"},
            [](M & m) -> auto& { return m.elements.triangles; },
            "of cloth or a balloon, counter-clockwise from outside"),
        field<M>(
            "tetrahedra", IndexList<4>{"tetrahedra [i, j, k, l]", "points"},
            [](M & m) -> auto& { return m.elements.tetrahedra; },
            "of a solid; seen from the fourth point, the first three run counter-clockwise"),
    };
    return table;
}

void check_mesh(const Draft& draft, const Node& node) {
    node.require_one("file", "points");
    node.require_beside("scale", "file");
    const DeformableKind kind = draft.spec.kind;
    const std::string wanted = kind == DeformableKind::rope    ? "segments"
                               : kind == DeformableKind::solid ? "tetrahedra"
                                                               : "triangles";
    for (const char* key : {"segments", "triangles", "tetrahedra"}) {
        if (!node.has(key)) continue;
        if (node.has("file"))
            node.at(key).fail("\"" + std::string(key) + "\" go with \"points\", not with \"file\"");
        if (key != wanted)
            node.at(key).fail("a " + std::string(name_of(kind)) + " is made of \"" + wanted +
                              "\", not of \"" + key + "\"");
    }
    if (node.has("points") && !node.has(wanted)) node.fail("\"" + wanted + "\" are missing");
}

Eigen::Vector3d middle_of(const Elements& elements, std::size_t tetrahedron) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t i : elements.tetrahedra[tetrahedron]) sum += elements.points[i];
    return sum / 4;
}

std::string place_of(const Eigen::Vector3d& p) {
    return "(" + short_number(p.x()) + ", " + short_number(p.y()) + ", " + short_number(p.z()) +
           ")";
}

void read_mesh_shape(Draft& draft, const Node& node) {
    MeshKeys mesh;
    read_object(mesh, node, mesh_table());
    check_mesh(draft, node);
    if (node.has("file")) {
        FileElements file = read_elements_file(node.at("file"), mesh.scale, draft.spec.kind);
        const auto remark = [&](const std::string& sentence) {
            draft.scene->scene.remarks.push_back("deformable \"" + draft.spec.name +
                                                 "\": " + sentence);
        };
        if (file.merged > 0)
            remark(std::to_string(file.merged) + " points of \"" + mesh.file +
                   "\" lay where others did and became one with them");
        if (!file.inverted.empty())
            remark("tetrahedra of \"" + mesh.file + "\" that were inside out were turned over: " +
                   std::to_string(file.inverted.size()) + " of " +
                   std::to_string(file.elements.tetrahedra.size()) + ", the first about " +
                   place_of(middle_of(file.elements, file.inverted.front())));
        mesh.elements = std::move(file.elements);
    }
    require_room(*draft.scene, static_cast<double>(mesh.elements.points.size()), node);
    if (draft.spec.kind == DeformableKind::solid &&
        !deformable_faults::element_fault(mesh.elements.points, mesh.elements.tetrahedra))
        mesh.elements.triangles = surface_of(mesh.elements.tetrahedra);
    take(draft, std::move(mesh.elements));
}

/// A shape, and the kinds of deformables that can have it.
Field<Draft> shape(const char* key, const SchemaJson& schema,
                   const std::vector<DeformableKind>& kinds, void (*read)(Draft&, const Node&),
                   const char* meaning) {
    const auto reads = [=](Draft& draft, const Node& node) {
        if (std::find(kinds.begin(), kinds.end(), draft.spec.kind) == kinds.end()) {
            std::string able;
            for (const DeformableKind k : kinds)
                able += std::string(able.empty() ? "" : " or ") + name_of(k);
            node.fail("a " + std::string(name_of(draft.spec.kind)) + " cannot be a \"" + key +
                      "\", which is for " + able);
        }
        read(draft, node);
    };
    return special<Draft>(key, schema, reads, meaning);
}

const Table<Draft>& shape_table_of_deformables() {
    using enum DeformableKind;
    static const Table<Draft> table = {
        shape("grid", object_schema(grid_keys()), {cloth}, read_grid,
              "cloth: rectangle in the plane of x and z, about the origin"),
        shape("sphere", object_schema(ball_table()), {cloth, balloon, solid}, read_ball,
              "balloon, or solid ball of tetrahedra, about the origin"),
        shape("tube", object_schema(tube_table()), {cloth, balloon}, read_tube,
              "tube about y: open of cloth, with flat lids of a balloon"),
        shape("lattice", object_schema(lattice_table()), {solid}, read_lattice,
              "solid of cells that are cut into tetrahedra: a box, or what fills a mesh"),
        shape("line", object_schema(line_table()), {rope}, read_line, "rope from point to point"),
        shape("mesh", object_schema(mesh_table()), {rope, cloth, balloon, solid}, read_mesh_shape,
              "points and elements, from a file or listed here"),
    };
    return table;
}

}  // namespace

void require_room(const SceneDraft& draft, double points, const Node& node) {
    if (points > static_cast<double>(kMaxParticles - draft.points))
        node.fail("these are " + short_number(points) + " points, but a scene may have at most " +
                  std::to_string(kMaxParticles));
}

void read_deformable_shape(DeformableDraft& draft, const Node& node) {
    read_object(draft, node, shape_table_of_deformables());
    if (node.size() != 1)
        node.fail("a shape has exactly one key, its kind, but here are " +
                  std::to_string(node.size()) + advice("", keys_of(shape_table_of_deformables())));
}

void add_deformable_shape_definitions(SchemaJson& definitions) {
    SchemaJson shape = object_schema(shape_table_of_deformables());
    shape["minProperties"] = shape["maxProperties"] = 1;
    definitions["deformable_shape"] = shape;
}

}  // namespace plumb::reader
