// SPDX-License-Identifier: MIT
#include "ode/geoms.h"

#include <stdexcept>

namespace plumb::ode {
namespace {

/// A hull about the mean of its vertices, with its merged faces as polygons. The middle of its
/// bounds will not do: that of a wedge lies on a face, and ODE wants the origin inside of all.
dGeomID make_hull(Geoms& g, const Part& part) {
    const Shape& s = part.shape;
    for (std::uint32_t i = 0; i < s.vertex_count; ++i) g.centre = g.centre + s.vertices[i];
    g.centre = (1.0 / s.vertex_count) * g.centre;
    for (std::uint32_t i = 0; i < s.vertex_count; ++i) {
        const Vec3 p = s.vertices[i] - g.centre;
        g.points.insert(g.points.end(), {p.x, p.y, p.z});
    }
    for (const HullFace& face : part.faces) {
        const double offset = dot(face.normal, s.vertices[face.corners[0]] - g.centre);
        g.planes.insert(g.planes.end(), {face.normal.x, face.normal.y, face.normal.z, offset});
        g.polygons.push_back(static_cast<unsigned>(face.corners.size()));
        g.polygons.insert(g.polygons.end(), face.corners.begin(), face.corners.end());
    }
    return dCreateConvex(nullptr, g.planes.data(), static_cast<unsigned>(part.faces.size()),
                         g.points.data(), s.vertex_count, g.polygons.data());
}

/// ODE's own mesh, over vertices and corners that stay where they are.
dGeomID make_mesh(Geoms& g, const Vec3* vertices, std::size_t vertex_count,
                  const std::uint32_t* corners, std::size_t count) {
    static_assert(sizeof(dTriIndex) == sizeof(std::uint32_t) && sizeof(dReal) == sizeof(double));
    g.mesh = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(g.mesh, vertices, sizeof(Vec3), static_cast<int>(vertex_count),
                                corners, static_cast<int>(3 * count), 3 * sizeof(dTriIndex));
    return dCreateTriMesh(nullptr, g.mesh, nullptr, nullptr, nullptr);
}

dGeomID make_height_field(Geoms& g, const Surface& field) {
    for (const Facet& f : field.topology().facets)
        g.corners.insert(g.corners.end(), f.corner, f.corner + 3);
    return make_mesh(g, field.vertices().data(), field.vertices().size(), g.corners.data(),
                     field.size());
}

bool along_z(ShapeKind kind) { return kind == ShapeKind::capsule || kind == ShapeKind::cylinder; }

void place(dGeomID geom, const Part& part, Vec3 centre) {
    const Frame& f = part.world;
    const bool turned = along_z(part.shape.kind);
    const Vec3 x = f.axis[0], y = turned ? -f.axis[2] : f.axis[1],
               z = turned ? f.axis[1] : f.axis[2];
    const dMatrix3 rows = {x.x, y.x, z.x, 0, x.y, y.y, z.y, 0, x.z, y.z, z.z, 0};
    const Vec3 p = to_outer(f, centre);
    dGeomSetPosition(geom, p.x, p.y, p.z);
    if (part.shape.kind == ShapeKind::sphere) return;  // looks the same however it is turned
    dGeomSetRotation(geom, rows);
}

}  // namespace

Geoms::~Geoms() {
    if (exact) dGeomDestroy(exact);
    if (wide) dGeomDestroy(wide);
    if (mesh) dGeomTriMeshDataDestroy(mesh);
}

std::shared_ptr<Geoms> make_geoms(const Part& part) {
    auto g = std::make_shared<Geoms>();
    const Shape& s = part.shape;
    switch (s.kind) {
        case ShapeKind::plane:
            g->exact = dCreatePlane(nullptr, 0, 1, 0, 0);
            break;
        case ShapeKind::sphere:
            g->exact = dCreateSphere(nullptr, s.radius);
            g->wide = dCreateSphere(nullptr, s.radius);
            break;
        case ShapeKind::box:
            g->exact = dCreateBox(nullptr, 2 * s.half_extents.x, 2 * s.half_extents.y,
                                  2 * s.half_extents.z);
            break;
        case ShapeKind::capsule:
            g->exact = dCreateCapsule(nullptr, s.radius, 2 * s.half_height);
            g->wide = dCreateCapsule(nullptr, s.radius, 2 * s.half_height);
            break;
        case ShapeKind::cylinder:
            g->exact = dCreateCylinder(nullptr, s.radius, 2 * s.half_height);
            break;
        case ShapeKind::hull:
            g->exact = make_hull(*g, part);
            break;
        case ShapeKind::mesh:
            g->exact = make_mesh(*g, s.vertices, s.vertex_count, s.faces, s.face_count);
            break;
        case ShapeKind::height_field:
            g->exact = make_height_field(*g, *part.surface);
            break;
        default:
            throw std::logic_error("a kind of shape that the table should have refused");
    }
    return g;
}

void place_geoms(const Part& part, double wider_by) {
    Geoms& g = geoms_of(part);
    const Shape& s = part.shape;
    if (s.kind == ShapeKind::plane) {
        const Vec3 n = part.world.axis[1];
        dGeomPlaneSetParams(g.exact, n.x, n.y, n.z, dot(n, part.world.origin));
        return;
    }
    if (g.wide && g.wider_by != wider_by) {
        if (s.kind == ShapeKind::sphere)
            dGeomSphereSetRadius(g.wide, s.radius + wider_by);
        else
            dGeomCapsuleSetParams(g.wide, s.radius + wider_by, 2 * s.half_height);
        g.wider_by = wider_by;
    }
    place(g.exact, part, g.centre);
    if (g.wide) place(g.wide, part, g.centre);
}

}  // namespace plumb::ode
