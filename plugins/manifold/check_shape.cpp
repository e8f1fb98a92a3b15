// SPDX-License-Identifier: MIT
#include "manifold/check_shape.h"

#include "manifold/linear.h"

namespace plumb {
namespace {

constexpr std::uint64_t kMostPoints = 1'000'000'000;  ///< of a height field

bool positive(double length) { return std::isfinite(length) && length > 0; }

bool finite_vertices(const Shape& shape) {
    for (std::uint32_t i = 0; i < shape.vertex_count; ++i)
        if (!finite(shape.vertices[i])) return false;
    return true;
}

const char* flaw_of_hull(const Shape& hull) {
    if (!hull.vertices || !hull.faces || hull.vertex_count < 4 || hull.face_count < 4)
        return "a hull needs at least four vertices and four faces";
    if (!finite_vertices(hull)) return "a vertex of a hull is not finite";
    const std::uint32_t* at_face = hull.faces;
    for (std::uint32_t f = 0; f < hull.face_count; ++f) {
        const std::uint32_t corners = *at_face++;
        if (corners < 3) return "a face of a hull has fewer than three corners";
        for (std::uint32_t c = 0; c < corners; ++c)
            if (*at_face++ >= hull.vertex_count)
                return "a face of a hull names a vertex that is not there";
    }
    return nullptr;
}

const char* flaw_of_mesh(const Shape& mesh) {
    if (!mesh.vertices || !mesh.faces || mesh.vertex_count < 3 || mesh.face_count < 1)
        return "a mesh needs at least one triangle";
    if (!finite_vertices(mesh)) return "a vertex of a mesh is not finite";
    for (std::uint32_t i = 0; i < 3 * mesh.face_count; ++i)
        if (mesh.faces[i] >= mesh.vertex_count)
            return "a triangle names a vertex that is not there";
    return nullptr;
}

const char* flaw_of_height_field(const Shape& field) {
    if (!field.heights || field.rows < 2 || field.columns < 2)
        return "a height field needs at least two rows and two columns";
    if (!positive(field.spacing_x) || !positive(field.spacing_z))
        return "the spacing of a height field must be positive";
    const std::uint64_t points = std::uint64_t{field.rows} * field.columns;
    if (points > kMostPoints) return "a height field may have at most a thousand million points";
    for (std::uint64_t i = 0; i < points; ++i)
        if (!std::isfinite(field.heights[i])) return "a height of a height field is not finite";
    return nullptr;
}

const char* flaw_of_compound(const Shape& compound) {
    if (!compound.parts || compound.part_count < 1) return "a compound needs at least one part";
    for (std::uint32_t i = 0; i < compound.part_count; ++i) {
        const Shape& part = compound.parts[i].shape;
        if (part.kind == ShapeKind::compound || part.kind == ShapeKind::plane)
            return "a part of a compound must be neither a compound nor a plane";
        if (const char* flaw = flaw_of(part)) return flaw;
    }
    return nullptr;
}

}  // namespace

const char* flaw_of(const Shape& shape) {
    switch (shape.kind) {
        case ShapeKind::plane:
            return nullptr;
        case ShapeKind::sphere:
            return positive(shape.radius) ? nullptr : "a radius must be positive";
        case ShapeKind::box:
            return positive(shape.half_extents.x) && positive(shape.half_extents.y) &&
                           positive(shape.half_extents.z)
                       ? nullptr
                       : "the half extents of a box must be positive";
        case ShapeKind::capsule:
            return positive(shape.radius) && std::isfinite(shape.half_height) &&
                           shape.half_height >= 0
                       ? nullptr
                       : "a capsule needs a positive radius and a half height of at least 0";
        case ShapeKind::cylinder:
        case ShapeKind::cone:
            return positive(shape.radius) && positive(shape.half_height)
                       ? nullptr
                       : "radius and half height must be positive";
        case ShapeKind::hull:
            return flaw_of_hull(shape);
        case ShapeKind::mesh:
            return flaw_of_mesh(shape);
        case ShapeKind::height_field:
            return flaw_of_height_field(shape);
        case ShapeKind::compound:
            return flaw_of_compound(shape);
    }
    return "this kind of shape is not known";
}

}  // namespace plumb
