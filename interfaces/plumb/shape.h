// SPDX-License-Identifier: MIT
/// The closed list of shapes that a collider may be asked about, as plain values.
///
/// Lengths are in metres. A shape lives in its own frame; `ShapePlacement::local` puts that frame
/// into the frame of its body. Round shapes have their axis along y. Memory that a shape points to
/// (vertices, faces, heights, parts) belongs to the core and stays valid, at the same address,
/// until the body is removed.
#pragma once

#include <cstdint>

namespace plumb {

struct Vec3 {
    double x, y, z;
};

/// Unit quaternion x i + y j + z k + w.
struct Quat {
    double x, y, z, w;
};

/// Maps a point p of the local frame to rotation · p + position.
struct Pose {
    Vec3 position;  ///< [m]
    Quat rotation;
};

enum class ShapeKind : std::uint32_t {
    plane = 0,     ///< the half-space y ≤ 0; its surface normal is +y
    sphere,        ///< radius, about the origin
    box,           ///< half_extents, about the origin
    capsule,       ///< radius; the segment |y| ≤ half_height is its core
    cylinder,      ///< radius, |y| ≤ half_height, flat ends
    cone,          ///< base of `radius` at y = −half_height, apex at y = +half_height
    hull,          ///< convex polyhedron: vertices and faces
    mesh,          ///< triangles, closed or open: vertices and triangles
    height_field,  ///< heights over a grid in the x–z plane; solid below
    compound       ///< parts, each with a pose; a part is never a compound or a plane
};
inline constexpr std::uint32_t kShapeKindCount = 10;

/// "plane", "sphere", …; "?" for a value outside of the list.
inline const char* name_of(ShapeKind kind) noexcept {
    constexpr const char* names[kShapeKindCount] = {"plane",        "sphere",  "box",  "capsule",
                                                    "cylinder",     "cone",    "hull", "mesh",
                                                    "height_field", "compound"};
    const auto i = static_cast<std::uint32_t>(kind);
    return i < kShapeKindCount ? names[i] : "?";
}

struct ShapePart;

/// One shape. Only the members named for its kind above mean anything; the rest are zero.
struct Shape {
    ShapeKind kind;
    std::uint32_t reserved;  ///< zero
    Vec3 half_extents;       ///< box [m]
    double radius;           ///< sphere, capsule, cylinder, cone [m]
    double half_height;      ///< capsule (of its core segment), cylinder, cone [m]

    const Vec3* vertices;  ///< hull, mesh: [vertex_count], [m]
    std::uint32_t vertex_count;
    std::uint32_t face_count;    ///< hull: polygons; mesh: triangles
    const std::uint32_t* faces;  ///< hull: for each face its corner count, then its vertex indices,
                                 ///< counter-clockwise seen from outside; mesh: three vertex
                                 ///< indices a triangle, counter-clockwise
    const Vec3* face_normals;    ///< hull, mesh: [face_count], unit, outward

    const double*
        heights;  ///< height field: [rows × columns], row after row along z, y of the surface [m]
    std::uint32_t rows, columns;
    double spacing_x, spacing_z;  ///< height field: distance between columns, and between rows [m];
                                  ///< the grid is centred on the origin

    const ShapePart* parts;  ///< compound: [part_count]
    std::uint32_t part_count;
    std::uint32_t reserved2;  ///< zero
};

/// A part of a compound, and where it sits in the compound's frame.
struct ShapePart {
    Shape shape;
    Pose local;
};

}  // namespace plumb
