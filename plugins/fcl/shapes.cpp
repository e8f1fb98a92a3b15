// SPDX-License-Identifier: MIT
#include "fcl/shapes.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/OBBRSS.h>

#include <stdexcept>

namespace plumb::by_fcl {
namespace {

std::vector<fcl::Vector3d> vertices_of(const Shape& s) {
    std::vector<fcl::Vector3d> vertices;
    for (std::uint32_t i = 0; i < s.vertex_count; ++i) vertices.push_back(to_fcl(s.vertices[i]));
    return vertices;
}

std::shared_ptr<fcl::CollisionGeometryd> make_hull(const Part& part) {
    auto faces = std::make_shared<std::vector<int>>();
    for (const HullFace& face : part.faces) {
        faces->push_back(static_cast<int>(face.corners.size()));
        faces->insert(faces->end(), face.corners.begin(), face.corners.end());
    }
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>(vertices_of(part.shape));
    return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(part.faces.size()), faces);
}

std::shared_ptr<fcl::CollisionGeometryd> make_tree(const std::vector<fcl::Vector3d>& vertices,
                                                   const std::vector<fcl::Triangle>& triangles) {
    auto tree = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
    tree->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
    tree->addSubModel(vertices, triangles);
    tree->endModel();
    return tree;
}

std::shared_ptr<fcl::CollisionGeometryd> make_mesh(const Shape& s) {
    std::vector<fcl::Triangle> triangles;
    for (std::uint32_t i = 0; i < s.face_count; ++i)
        triangles.emplace_back(s.faces[3 * i], s.faces[3 * i + 1], s.faces[3 * i + 2]);
    return make_tree(vertices_of(s), triangles);
}

/// FCL has no height fields: the two triangles of every cell, as a mesh.
std::shared_ptr<fcl::CollisionGeometryd> make_height_field(const Surface& field) {
    std::vector<fcl::Vector3d> vertices;
    for (const Vec3& v : field.vertices()) vertices.push_back(to_fcl(v));
    std::vector<fcl::Triangle> triangles;
    for (const Facet& f : field.topology().facets)
        triangles.emplace_back(f.corner[0], f.corner[1], f.corner[2]);
    return make_tree(vertices, triangles);
}

std::shared_ptr<fcl::CollisionGeometryd> make_shape(const Part& part) {
    const Shape& s = part.shape;
    const double length = 2 * s.half_height;
    switch (s.kind) {
        case ShapeKind::plane:
            return std::make_shared<fcl::Halfspaced>(fcl::Vector3d(0, 1, 0), 0);
        case ShapeKind::sphere:
            return std::make_shared<fcl::Sphered>(s.radius);
        case ShapeKind::box:
            return std::make_shared<fcl::Boxd>(to_fcl(2 * s.half_extents));
        case ShapeKind::capsule:
            return std::make_shared<fcl::Capsuled>(s.radius, length);
        case ShapeKind::cylinder:
            return std::make_shared<fcl::Cylinderd>(s.radius, length);
        case ShapeKind::cone:
            return std::make_shared<fcl::Coned>(s.radius, length);
        case ShapeKind::hull:
            return make_hull(part);
        case ShapeKind::mesh:
            return make_mesh(s);
        case ShapeKind::height_field:
            return make_height_field(*part.surface);
        default:
            throw std::logic_error("a kind of shape that the table should have refused");
    }
}

bool along_z(ShapeKind kind) {
    return kind == ShapeKind::capsule || kind == ShapeKind::cylinder || kind == ShapeKind::cone;
}

}  // namespace

std::shared_ptr<Geometry> make_geometry(const Part& part) {
    auto made = std::make_shared<Geometry>();
    made->shape = make_shape(part);
    made->shape->computeLocalAABB();
    return made;
}

void place_geometry(const Part& part) {
    const Frame& f = part.world;
    const bool turned = along_z(part.shape.kind);
    fcl::Transform3d& place = geometry_of(part).place;
    place.linear().col(0) = to_fcl(f.axis[0]);
    place.linear().col(1) = to_fcl(turned ? -f.axis[2] : f.axis[1]);
    place.linear().col(2) = to_fcl(turned ? f.axis[1] : f.axis[2]);
    place.translation() = to_fcl(f.origin);
}

}  // namespace plumb::by_fcl
