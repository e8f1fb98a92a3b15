// SPDX-License-Identifier: MIT
#include "bullet/shapes.h"

#include "manifold/support.h"

#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <stdexcept>

namespace plumb::bullet {
namespace {

#ifdef PLUMB_BULLET_SINGLE
static_assert(sizeof(btScalar) == sizeof(float), "bullet_float needs Bullet in single precision");
#else
static_assert(sizeof(btScalar) == sizeof(double), "bullet needs Bullet in double precision");
#endif

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

/// Bullet's own mesh, over vertices and corners that stay where they are.
void make_mesh(Shapes& made, const Vec3* vertices, std::size_t vertex_count,
               const std::uint32_t* corners, std::size_t count) {
    btIndexedMesh mesh;
    mesh.m_numTriangles = static_cast<int>(count);
    mesh.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(corners);
    mesh.m_triangleIndexStride = 3 * sizeof(std::uint32_t);
    mesh.m_numVertices = static_cast<int>(vertex_count);
    mesh.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices);
    mesh.m_vertexStride = sizeof(Vec3);
    mesh.m_vertexType = PHY_DOUBLE;
    made.triangles = std::make_unique<btTriangleIndexVertexArray>();
    made.triangles->addIndexedMesh(mesh, PHY_INTEGER);
    auto shape = std::make_unique<btGImpactMeshShape>(made.triangles.get());
    shape->setMargin(0);
    shape->updateBound();
    made.other = std::move(shape);
}

void make_height_field(Shapes& made, const Surface& field) {
    for (const Facet& f : field.topology().facets)
        made.corners.insert(made.corners.end(), f.corner, f.corner + 3);
    make_mesh(made, field.vertices().data(), field.vertices().size(), made.corners.data(),
              field.size());
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
            make_mesh(*made, s.vertices, s.vertex_count, s.faces, s.face_count);
            break;
        case ShapeKind::height_field:
            make_height_field(*made, *part.surface);
            break;
        default:
            throw std::logic_error("a kind of shape that the table should have refused");
    }
    return made;
}

std::shared_ptr<Shapes> make_triangle() {
    auto made = std::make_shared<Shapes>();
    made->cushioned = std::make_unique<btTriangleShape>(btVector3(0, 0, 0), btVector3(1, 0, 0),
                                                        btVector3(0, 0, 1));
    return made;
}

void fit_triangle(const Part& triangle) {
    Shapes& shapes = shapes_of(triangle);
    auto& shape = static_cast<btTriangleShape&>(*shapes.cushioned);
    for (int i = 0; i < 3; ++i) shape.m_vertices1[i] = bt(triangle.shape.vertices[i]);
    shapes.cushion = std::min(kCushion, 0.01 * size_of(triangle));
    shape.setMargin(shapes.cushion);
    place_shapes(triangle);
}

void place_shapes(const Part& part) {
    Shapes& shapes = shapes_of(part);
    const Frame& f = part.world;
    const Vec3 &x = f.axis[0], &y = f.axis[1], &z = f.axis[2];
    shapes.turn = btMatrix3x3(bt(x.x), bt(y.x), bt(z.x), bt(x.y), bt(y.y), bt(z.y), bt(x.z),
                              bt(y.z), bt(z.z));
    if (shapes.grown_box) {
        const Vec3 grown{part.expansion, part.expansion, part.expansion};
        shapes.grown_box->setImplicitShapeDimensions(bt(part.shape.half_extents + grown));
    }
}

}  // namespace plumb::bullet
