// SPDX-License-Identifier: MIT
/// Shapes: an object with exactly one key, which names the kind.
#include <algorithm>

#include "reader/drafts.h"
#include "reader/shapes/height_fields.h"
#include "reader/shapes/polyhedra.h"
#include "reader/shapes/read_torus.h"

namespace plumb::reader {

namespace {

using G = Geometry;

const Table<G>& plane_table() {
    static const Table<G> table;
    return table;
}

const Table<G>& sphere_table() {
    static const Table<G> table = {
        field<G>("radius", Number{kLength}, &G::radius, "[m]", Presence::required)};
    return table;
}

const Table<G>& box_table() {
    static const Table<G> table = {
        field<G>("half_extents", Vector3{kLength}, &G::half_extents,
                 "half the length of each edge [m]"),
        special<G>(
            "size", Vector3{kLength}.schema(),
            [](G& g, const Node& node) { g.half_extents = Vector3{kLength}.read(node) / 2; },
            "length of each edge [m], in place of half_extents")};
    return table;
}

const Table<G>& round_table() {
    static const Table<G> table = {
        field<G>("radius", Number{kLength}, &G::radius, "[m]", Presence::required),
        field<G>("half_height", Number{kLength}, &G::half_height,
                 "half the height along y, of a capsule without its caps [m]", Presence::required)};
    return table;
}

struct CompoundDraft {
    const SceneDraft* scene;
    std::vector<GeometryPart> parts;
    double scale = 1;
};

struct PartDraft {
    const SceneDraft* scene;
    GeometryPart part;
};

void read_part_shape(PartDraft& draft, const Node& node) {
    const Scene& scene = draft.scene->scene;
    draft.part.geometry = node.json().is_string() ? scene.geometries[draft.scene->shapes.find(node)]
                                                  : read_geometry(*draft.scene, node);
    const ShapeKind kind = draft.part.geometry.kind;
    if (kind == ShapeKind::compound || kind == ShapeKind::plane) {
        node.fail(std::string("a part of a compound cannot be a ") + name_of(kind));
    }
}

const Table<PartDraft>& part_table() {
    using P = PartDraft;
    static const Table<P> table = {
        special<P>("shape", reference_to("shape_or_name"), read_part_shape,
                   "a shape, or the name of one that is no compound", Presence::required),
        field<P>(
            "position", Vector3{kCoordinate}, [](P & p) -> auto& { return p.part.local.position; },
            "of the part in the compound's frame [m]"),
        field<P>(
            "rotation", Rotation{}, [](P & p) -> auto& { return p.part.local.rotation; },
            "of the part in the compound's frame"),
    };
    return table;
}

void read_parts(CompoundDraft& draft, const Node& node) {
    if (!node.json().is_array() || node.size() == 0)
        node.fail_wanting("a list of at least one part");
    for (std::size_t i = 0; i < node.size(); ++i) {
        PartDraft part{draft.scene, {}};
        read_object(part, node.at(i), part_table());
        draft.parts.push_back(std::move(part.part));
    }
}

const Table<CompoundDraft>& compound_table() {
    using C = CompoundDraft;
    static const Table<C> table = {
        special<C>("parts", list_of("part"), read_parts, "shapes that move as one body"),
        field<C>("scale", Number{kScale}, &C::scale, "factor on the coordinates of the file"),
        special<C>(
            "obj", Text{}.schema(),
            [](C& c, const Node& node) { c.parts = hulls_of_file(node, c.scale); },
            "Wavefront OBJ file, whose objects or groups each become a hull"),
    };
    return table;
}

/// Reads a kind whose keys are plain members of Geometry.
auto reads(ShapeKind kind, const Table<G>& table) {
    return [kind, &table](ShapeDraft& draft, const Node& node) {
        draft.geometry.kind = kind;
        read_object(draft.geometry, node, table);
    };
}

void read_box(ShapeDraft& draft, const Node& node) {
    reads(ShapeKind::box, box_table())(draft, node);
    node.require_one("half_extents", "size");
}

void read_compound(ShapeDraft& draft, const Node& node) {
    CompoundDraft compound{draft.scene, {}};
    read_object(compound, node, compound_table());
    node.require_one("parts", "obj");
    node.require_beside("scale", "obj");
    draft.geometry.kind = ShapeKind::compound;
    draft.geometry.parts = std::move(compound.parts);
}

SchemaJson with_alternatives(SchemaJson json, const char* one, const char* other) {
    json["oneOf"] = {{{"required", {one}}}, {{"required", {other}}}};
    return json;
}

bool is_compound(const Node& node) { return node.has("compound"); }

}  // namespace

const Table<ShapeDraft>& shape_table() {
    using D = ShapeDraft;
    const auto plain = [](const char* key, ShapeKind kind, const Table<G>& table,
                          const char* meaning) {
        return special<D>(key, object_schema(table), reads(kind, table), meaning);
    };
    static const Table<D> table = {
        plain("plane", ShapeKind::plane, plane_table(), "half-space y ≤ 0"),
        plain("sphere", ShapeKind::sphere, sphere_table(), "ball about the origin"),
        special<D>("box", with_alternatives(object_schema(box_table()), "half_extents", "size"),
                   read_box, "box about the origin"),
        plain("capsule", ShapeKind::capsule, round_table(), "cylinder along y with round caps"),
        plain("cylinder", ShapeKind::cylinder, round_table(), "cylinder along y"),
        plain("cone", ShapeKind::cone, round_table(), "cone along y, apex at +half_height"),
        special<D>("hull", hull_schema(), read_hull, "convex hull of points"),
        special<D>("mesh", mesh_schema(), read_mesh, "triangles"),
        special<D>("height_field", height_field_schema(), read_height_field,
                   "heights over a grid in x and z, centred on the origin; solid below"),
        special<D>("torus", torus_schema(), read_torus,
                   "ring about y, as a compound of convex wedges that contain it"),
        special<D>("compound", with_alternatives(object_schema(compound_table()), "parts", "obj"),
                   read_compound, "several shapes as one"),
    };
    return table;
}

Geometry read_geometry(const SceneDraft& draft, const Node& node) {
    ShapeDraft shape{&draft, {}};
    read_object(shape, node, shape_table());
    if (node.size() != 1) {
        node.fail("a shape has exactly one key, its kind, but here are " +
                  std::to_string(node.size()) + advice("", keys_of(shape_table())));
    }
    return std::move(shape.geometry);
}

void read_shapes(SceneDraft& draft, const Node& node) {
    if (!node.json().is_object()) node.fail_wanting("an object of shapes by name");
    // Compounds last, for their parts may name the others.
    for (const bool compounds : {false, true}) {
        for (const auto& item : node.json().items()) {
            const Node shape = node.at(item.key());
            if (is_compound(shape) != compounds) continue;
            Geometry geometry = read_geometry(draft, shape);
            geometry.name = item.key();
            draft.shapes.add(item.key(), static_cast<std::uint32_t>(draft.scene.geometries.size()),
                             shape);
            draft.scene.geometries.push_back(std::move(geometry));
        }
    }
}

void add_shape_definitions(SchemaJson& definitions) {
    SchemaJson shape = object_schema(shape_table());
    shape["minProperties"] = shape["maxProperties"] = 1;
    definitions["shape"] = shape;
    definitions["shape_or_name"] = {{"anyOf", {{{"type", "string"}}, reference_to("shape")}}};
    definitions["part"] = object_schema(part_table());
    add_height_field_definitions(definitions);
}

}  // namespace plumb::reader
