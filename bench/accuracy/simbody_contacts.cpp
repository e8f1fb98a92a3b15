// SPDX-License-Identifier: MIT
#include "accuracy/simbody_contacts.h"

#include <cmath>
#include <limits>

namespace plumb::bench {
namespace {

constexpr double kTouches = 1e-6;  // largest gap at the start of boxes that stand on each other [m]
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

struct Face {
    Vector3d point, normal;  ///< in the world [m]
};

Face face_of_plane(const Placement& at) { return {at.position, at.rotation * Vector3d::UnitY()}; }

/// That face of a box which looks at a point.
Face face_of_box(const Placement& at, const Vector3d& half, const Vector3d& point) {
    const Vector3d way = at.rotation.conjugate() * (point - at.position);
    Eigen::Index axis = 0;
    way.cwiseQuotient(half).cwiseAbs().maxCoeff(&axis);
    const Vector3d normal = Vector3d::Unit(axis) * (way[axis] < 0 ? -1 : 1);
    return {at.position + at.rotation * normal.cwiseProduct(half), at.rotation * normal};
}

class Toucher {
public:
    Toucher(st::SimbodyMatterSubsystem& matter, std::vector<st::MobilizedBody>& bodies,
            const Scene& scene, const World& world)
        : matter_(matter), bodies_(bodies), scene_(scene), world_(world) {}

    void add(std::uint32_t i, std::uint32_t j) {
        const Geometry &g = geometry(i), &h = geometry(j);
        const Placement at = geometry_placement(world_.bodies, i);
        if (g.kind == ShapeKind::plane)
            add_on_face(i, face_of_plane(at), j, kNoLimit);
        else if (i < j && g.kind == ShapeKind::box && h.kind == ShapeKind::box)
            add_on_face(i, face_of_box(at, g.half_extents, world_.bodies.position[j]), j, kTouches);
        else if (i < j && g.kind == ShapeKind::sphere && h.kind == ShapeKind::sphere)
            add_spheres(i, j);
    }

private:
    const Geometry& geometry(std::uint32_t i) const {
        return scene_.geometries[scene_.bodies[i].geometry];
    }

    /// Of body j. `reach`: the largest gap at the start [m].
    void add_on_face(std::uint32_t i, const Face& face, std::uint32_t j, double reach) {
        const Placement at = geometry_placement(world_.bodies, j);
        if (geometry(j).kind == ShapeKind::sphere) return add_sphere(i, face, j, at.position);
        for (int corner = 0; corner < 8; ++corner) {
            const Vector3d sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
            const Vector3d x =
                at.position + at.rotation * sign.cwiseProduct(geometry(j).half_extents);
            if (std::abs(face.normal.dot(x - face.point)) <= reach) add_corner(i, face, j, x);
        }
    }

    void add_corner(std::uint32_t i, const Face& face, std::uint32_t j, const Vector3d& x) {
        const SurfacePair& surface = world_.surface_pair(i, j);
        matter_.adoptUnilateralContact(new st::PointPlaneContact(
            bodies_[i], normal(i, face), height(i, face), bodies_[j], local(j, x),
            surface.restitution, surface.friction, surface.friction, 0));
    }

    void add_sphere(std::uint32_t i, const Face& face, std::uint32_t j, const Vector3d& x) {
        const SurfacePair& surface = world_.surface_pair(i, j);
        matter_.adoptUnilateralContact(new st::SpherePlaneContact(
            bodies_[i], normal(i, face), height(i, face), bodies_[j], local(j, x),
            geometry(j).radius, surface.restitution, surface.friction, surface.friction, 0));
    }

    void add_spheres(std::uint32_t i, std::uint32_t j) {
        const SurfacePair& surface = world_.surface_pair(i, j);
        matter_.adoptUnilateralContact(new st::SphereSphereContact(
            bodies_[i], st::Vec3(0), geometry(i).radius, bodies_[j], st::Vec3(0),
            geometry(j).radius, surface.restitution, surface.friction, surface.friction, 0));
    }

    /// In the frame of body i, which is the world's where it is fixed.
    st::Vec3 local(std::uint32_t i, const Vector3d& point) const {
        return to_simbody(is_dynamic(world_, i) ? in_body(world_.bodies, i, point) : point);
    }
    st::UnitVec3 normal(std::uint32_t i, const Face& face) const {
        return st::UnitVec3(local(i, face.point + face.normal) - local(i, face.point));
    }
    double height(std::uint32_t i, const Face& face) const {
        return st::dot(normal(i, face), local(i, face.point));
    }

    st::SimbodyMatterSubsystem& matter_;
    std::vector<st::MobilizedBody>& bodies_;
    const Scene& scene_;
    const World& world_;
};

}  // namespace

void add_contacts(st::SimbodyMatterSubsystem& matter, std::vector<st::MobilizedBody>& bodies,
                  const Scene& scene, const World& world) {
    Toucher toucher(matter, bodies, scene, world);
    const auto count = static_cast<std::uint32_t>(bodies.size());
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t j = 0; j < count; ++j)
            if (i != j && is_dynamic(world, j)) toucher.add(i, j);
}

}  // namespace plumb::bench
