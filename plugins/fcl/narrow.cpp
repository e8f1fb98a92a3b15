// SPDX-License-Identifier: MIT
/// Boxes by FCL's box test, on the true boxes where they overlap and on larger ones where they do
/// not; spheres with simple shapes by its closed forms; other convex pairs by its signed
/// distance, and where that gives up by its `collide`; meshes and height fields by the signed
/// distance of each triangle; two meshes by shared code.
///
/// FCL's normals point from its first argument to its second, ours from b to a. A mesh always goes
/// first: FCL's answer for a shape and a mesh points out of the mesh whatever the order.
#include "fcl/narrow.h"

#include "fcl/closest.h"
#include "fcl/shapes.h"
#include "manifold/gjk.h"
#include "manifold/least_overlap.h"
#include "manifold/mesh_pair.h"
#include "manifold/mesh_points.h"
#include "manifold/sharpen.h"
#include "manifold/support.h"

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/detail/primitive_shape_algorithm/box_box.h>
#include <fcl/narrowphase/detail/primitive_shape_algorithm/sphere_box.h>
#include <fcl/narrowphase/detail/primitive_shape_algorithm/sphere_capsule.h>
#include <fcl/narrowphase/detail/primitive_shape_algorithm/sphere_cylinder.h>
#include <fcl/narrowphase/detail/primitive_shape_algorithm/sphere_sphere.h>

namespace plumb::by_fcl {
namespace {

constexpr std::size_t kMostFromFcl = 512;
constexpr double kDeep =
    0.01;  ///< overlap, as a share of size, that is compared with other ways out

bool is(const Part& part, ShapeKind kind) { return part.shape.kind == kind; }
bool either(const Part& a, const Part& b, ShapeKind kind) { return is(a, kind) || is(b, kind); }
bool has_triangles(const Part& part) { return has_surface(part.shape.kind); }

/// The closest points of parts that FCL is silent or wrong about, or the direction of least
/// overlap.
Witness ask_gjk(const Part& a, const Part& b) {
    Witness witness;
    if (!closest_when_apart(witness, a, b) && !closest_when_touching(witness, a, b))
        return least_overlap(a, b);
    witness.shared = true;
    return witness;
}

/// Of FCL's normal and the one that GJK finds, the one of less overlap is nearer to the truth.
void compare_with_gjk(Witness& witness, const Part& a, const Part& b) {
    const double implied = support_gap(a, b, unit_or(witness.normal, {0, 1, 0}));
    const Witness other = ask_gjk(a, b);
    witness.approximate = true;
    const double better = implied + 1e-5 * (size_of(a) + size_of(b));
    if (support_gap(a, b, other.normal) > better) witness = other;
}

/// FCL can name a normal along which the true shapes overlap far more than it says.
void validate_normal(Witness& witness, const Part& a, const Part& b) {
    const double implied = support_gap(a, b, unit_or(witness.normal, {0, 1, 0}));
    if (implied <= witness.gap - 1e-4 * (size_of(a) + size_of(b))) compare_with_gjk(witness, a, b);
}

bool has_closed_form(const Part& sphere, const Part& other) {
    return is(sphere, ShapeKind::sphere) &&
           (is(other, ShapeKind::sphere) || is(other, ShapeKind::box) ||
            is(other, ShapeKind::capsule) || is(other, ShapeKind::cylinder));
}

/// FCL's closed form for a sphere and a shape that has one.
bool meet_sphere(const fcl::Sphered& sphere, const fcl::Transform3d& sphere_place,
                 const fcl::CollisionGeometryd& other, const fcl::Transform3d& other_place,
                 std::vector<fcl::ContactPointd>& points) {
    const auto meet = [&](auto test, const auto& shape) {
        return test(sphere, sphere_place, shape, other_place, &points);
    };
    switch (other.getNodeType()) {
        case fcl::GEOM_SPHERE:
            return meet(fcl::detail::sphereSphereIntersect<double>,
                        static_cast<const fcl::Sphered&>(other));
        case fcl::GEOM_BOX:
            return meet(fcl::detail::sphereBoxIntersect<double>,
                        static_cast<const fcl::Boxd&>(other));
        case fcl::GEOM_CAPSULE:
            return meet(fcl::detail::sphereCapsuleIntersect<double>,
                        static_cast<const fcl::Capsuled&>(other));
        default:
            return meet(fcl::detail::sphereCylinderIntersect<double>,
                        static_cast<const fcl::Cylinderd&>(other));
    }
}

/// Index of the triangle that FCL names for a surface.
std::uint32_t triangle(const Part& part, intptr_t index) {
    return has_triangles(part) && index >= 0 ? static_cast<std::uint32_t>(index) : 0;
}

}  // namespace

struct Narrow::Scratch {
    fcl::CollisionRequestd request{kMostFromFcl, true};
    fcl::CollisionResultd result;
    std::vector<fcl::ContactPointd> points;
    MeshScratch triangles;

    void collide(const Part& first, const Part& second) {
        const Geometry &p = geometry_of(first), &q = geometry_of(second);
        result.clear();
        fcl::collide(p.shape.get(), p.place, q.shape.get(), q.place, request, result);
    }
};

Narrow::Narrow() : scratch_(std::make_unique<Scratch>()) {
    scratch_->request.gjk_solver_type = fcl::GST_LIBCCD;
}
Narrow::~Narrow() = default;

/// FCL's box against box with all half extents grown by `grown` [m].
bool Narrow::ask_boxes(Witness& witness, const Part& a, const Part& b, double grown) {
    const Vec3 more{grown, grown, grown};
    fcl::Vector3d normal = fcl::Vector3d::Zero();
    double depth = 0;
    int code = 0;
    scratch_->points.clear();
    fcl::detail::boxBox2(to_fcl(2 * (a.shape.half_extents + more)), geometry_of(a).place,
                         to_fcl(2 * (b.shape.half_extents + more)), geometry_of(b).place, normal,
                         &depth, &code, 1, scratch_->points);
    // Without a code an axis parts the boxes. With one there is a normal, even where FCL's own
    // clipping lost the points.
    if (code == 0) return false;
    const Vec3 middle = 0.5 * (a.world.origin + b.world.origin);
    const Vec3 point = scratch_->points.empty() ? middle : from_fcl(scratch_->points[0].pos);
    witness = {-from_fcl(normal), point, 2 * grown - std::abs(depth)};
    return true;
}

/// FCL's closed forms for a sphere with something simple. The sphere is asked about larger by the
/// distance of detection, which is exact for it.
bool Narrow::ask_sphere(Witness& witness, const Part& a, const Part& b) {
    const bool sphere_first = has_closed_form(a, b);
    const Part &sphere = sphere_first ? a : b, &other = sphere_first ? b : a;
    const double margin = pair_margin(a, b);
    const fcl::Sphered wide(sphere.shape.radius + margin);
    const Geometry &p = geometry_of(sphere), &q = geometry_of(other);
    auto& points = scratch_->points;
    points.clear();
    if (!meet_sphere(wide, p.place, *q.shape, q.place, points) || points.empty()) return false;
    const Vec3 n = from_fcl(points[0].normal);
    witness = {sphere_first ? -n : n, from_fcl(points[0].pos),
               margin - points[0].penetration_depth};
    return true;
}

/// FCL's deepest point of an overlap.
bool Narrow::ask_collide(Witness& witness, const Part& a, const Part& b) {
    scratch_->collide(a, b);
    bool found = false;
    for (std::size_t i = 0; i < scratch_->result.numContacts(); ++i) {
        const fcl::Contactd& c = scratch_->result.getContact(i);
        if (found && -c.penetration_depth >= witness.gap) continue;
        witness = {-from_fcl(c.normal), from_fcl(c.pos), -c.penetration_depth};
        found = finite(witness.normal) && finite(witness.point);
    }
    return found;
}

bool Narrow::ask(Witness& witness, const Part& a, const Part& b) {
    if (has_closed_form(a, b) || has_closed_form(b, a)) {
        if (!ask_sphere(witness, a, b)) return false;
        return validate_normal(witness, a, b), true;
    }
    if (is(a, ShapeKind::box) && is(b, ShapeKind::box)) {
        if (ask_boxes(witness, a, b, 0)) return validate_normal(witness, a, b), true;
        // Apart: the normal of larger boxes will do where it parts the true ones too, and two
        // points of them reach the gap that it implies.
        if (!ask_boxes(witness, a, b, 0.5 * pair_margin(a, b))) return false;
        const Vec3 n = unit_or(witness.normal, {0, 1, 0});
        if (support_gap(a, b, n) >= 0 && gap_is_reached(a, b, n)) return true;
    }
    const bool found = signed_distance(witness, a, b) == Answer::found;
    if (found && witness.gap > -kDeep * (size_of(a) + size_of(b)))
        return validate_normal(witness, a, b), true;
    // Of parts that just touch, or whose middles coincide, FCL may name any way out.
    if (!found && !ask_collide(witness, a, b)) return witness = ask_gjk(a, b), true;
    return compare_with_gjk(witness, a, b), true;
}

/// A triangle has no geometry of FCL's: its signed distance needs none.
bool Narrow::ask(Witness& witness, const Part& a, const Part& b, std::uint32_t) {
    if (signed_distance(witness, a, b) == Answer::found)
        validate_normal(witness, a, b);
    else
        witness = ask_gjk(a, b);
    sharpen_bent(witness, a, b);
    return true;
}

void Narrow::collide_convex(ContactList& contacts, DetectStats& stats, const Part& a,
                            const Part& b) {
    // A half-space needs no question: its normal is the contact's.
    Witness witness{{0, 1, 0}, is(a, ShapeKind::plane) ? b.world.origin : a.world.origin, 0};
    const bool plane = either(a, b, ShapeKind::plane);
    if (!plane && !ask(witness, a, b)) return;
    if (!plane) sharpen_bent(witness, a, b);
    build_manifold(contacts, stats, a, b, witness);
}

void Narrow::take_all(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b) {
    const bool turned = has_triangles(b) && !has_triangles(a);
    turned ? scratch_->collide(b, a) : scratch_->collide(a, b);
    for (std::size_t i = 0; i < scratch_->result.numContacts(); ++i) {
        const fcl::Contactd& c = scratch_->result.getContact(i);
        const Vec3 n = from_fcl(c.normal);
        const std::uint32_t ta = triangle(a, turned ? c.b2 : c.b1);
        const std::uint32_t tb = triangle(b, turned ? c.b1 : c.b2);
        // The sign of a depth differs by pair; every point that FCL gives is an overlap.
        const Witness w{turned ? n : -n, from_fcl(c.pos), -std::abs(c.penetration_depth),
                        has_triangles(a) || has_triangles(b)};
        const std::size_t before = contacts.size();
        add_raw(contacts, stats, a, b, w, w.approximate ? feature_key({ta, tb}) : 0);
        if (contacts.size() == before) continue;
        Contact& added = contacts.data()[before];
        if (a.index == 0 && has_triangles(a)) added.part_a = ta;
        if (b.index == 0 && has_triangles(b)) added.part_b = tb;
        anchor_sphere(added, a, b);
    }
}

void Narrow::collide_mesh(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b) {
    if (either(a, b, ShapeKind::plane)) return mesh_on_plane(contacts, stats, a, b);
    if (!has_triangles(a) || !has_triangles(b))
        return collide_triangles(contacts, stats, a, b, *this, scratch_->triangles);
    collide_meshes(contacts, stats, a, b);
}

void Narrow::collide_raw(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b) {
    // FCL's hulls and meshes crash on its half-spaces.
    const bool plane = either(a, b, ShapeKind::plane);
    if (plane && either(a, b, ShapeKind::mesh)) return mesh_on_plane(contacts, stats, a, b);
    if (plane && either(a, b, ShapeKind::hull)) return collide_convex(contacts, stats, a, b);
    take_all(contacts, stats, a, b);
}

}  // namespace plumb::by_fcl
