// SPDX-License-Identifier: MIT
#include "bullet/shapes.h"

#include "manifold/support.h"

#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <stdexcept>

namespace plumb::bullet {
namespace {

static_assert(sizeof(btScalar) == sizeof(double), "this plugin needs Bullet in double precision");

std::unique_ptr<btConvexShape> cushioned_box(Vec3 half, double cushion) {
    auto box = std::make_unique<btBoxShape>(bt(half + Vec3{cushion, cushion, cushion}));
    box->setMargin(cushion);
    return box;
}

std::unique_ptr<btBoxShape> sharp_box(Vec3 half) {
    auto box = std::make_unique<btBoxShape>(bt(half));
    box->setMargin(0);
    return box;
}

std::unique_ptr<btConvexShape> cushioned_hull(const Shape& s, double cushion) {
    auto hull = std::make_unique<btConvexHullShape>();
    for (std::uint32_t i = 0; i < s.vertex_count; ++i) hull->addPoint(bt(s.vertices[i]), false);
    hull->setMargin(cushion);
    hull->recalcLocalAabb();
    return hull;
}

std::unique_ptr<btConvexShape> cushioned_cylinder(const Shape& s, double cushion) {
    const double r = s.radius + cushion, h = s.half_height + cushion;
    auto cylinder = std::make_unique<btCylinderShape>(btVector3(r, h, r));
    cylinder->setMargin(cushion);
    return cylinder;
}

std::unique_ptr<btConvexShape> cushioned_cone(const Shape& s, double cushion) {
    auto cone = std::make_unique<btConeShape>(s.radius, 2 * s.half_height);
    cone->setMargin(cushion);
    return cone;
}

void make_mesh(Shapes& made, const Shape& s) {
    btIndexedMesh mesh;
    mesh.m_numTriangles = static_cast<int>(s.face_count);
    mesh.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(s.faces);
    mesh.m_triangleIndexStride = 3 * sizeof(std::uint32_t);
    mesh.m_numVertices = static_cast<int>(s.vertex_count);
    mesh.m_vertexBase = reinterpret_cast<const unsigned char*>(s.vertices);
    mesh.m_vertexStride = sizeof(Vec3);
    made.triangles = std::make_unique<btTriangleIndexVertexArray>();
    made.triangles->addIndexedMesh(mesh, PHY_INTEGER);
    auto shape = std::make_unique<btGImpactMeshShape>(made.triangles.get());
    shape->setMargin(0);
    shape->updateBound();
    made.other = std::move(shape);
}

}  // namespace

std::shared_ptr<Shapes> make_shapes(const Part& part) {
    auto made = std::make_shared<Shapes>();
    const Shape& s = part.shape;
    const bool round = s.kind == ShapeKind::sphere || s.kind == ShapeKind::capsule;
    made->cushion = round ? 0 : std::min(kCushion, 0.01 * size_of(part));
    switch (s.kind) {
        case ShapeKind::plane:
            made->other = std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), 0);
            break;
        case ShapeKind::sphere:
            made->cushioned = std::make_unique<btSphereShape>(s.radius);
            break;
        case ShapeKind::capsule:
            made->cushioned = std::make_unique<btCapsuleShape>(s.radius, 2 * s.half_height);
            break;
        case ShapeKind::box:
            made->cushioned = cushioned_box(s.half_extents, made->cushion);
            made->exact_box = sharp_box(s.half_extents);
            made->grown_box = sharp_box(s.half_extents);
            break;
        case ShapeKind::cylinder:
            made->cushioned = cushioned_cylinder(s, made->cushion);
            break;
        case ShapeKind::cone:
            made->cushioned = cushioned_cone(s, made->cushion);
            break;
        case ShapeKind::hull:
            made->cushioned = cushioned_hull(s, made->cushion);
            break;
        case ShapeKind::mesh:
            make_mesh(*made, s);
            break;
        default:
            throw std::logic_error("a kind of shape that the table should have refused");
    }
    return made;
}

void place_shapes(const Part& part) {
    Shapes& shapes = shapes_of(part);
    const Frame& f = part.world;
    const Vec3 &x = f.axis[0], &y = f.axis[1], &z = f.axis[2];
    shapes.place =
        btTransform(btMatrix3x3(x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z), bt(f.origin));
    if (shapes.grown_box) {
        const Vec3 grown{part.reach, part.reach, part.reach};
        shapes.grown_box->setImplicitShapeDimensions(bt(part.shape.half_extents + grown));
    }
}

}  // namespace plumb::bullet
