// SPDX-License-Identifier: MIT
/// A triangle that the part looks at face to face gives a manifold. One that it meets at an edge or
/// a corner counts only where no face does: beside faces such normals are mostly those of edges
/// inside a surface, which a part must slide over.
#include "fcl/triangles.h"

#include "fcl/closest.h"
#include "fcl/shapes.h"
#include "manifold/mesh_points.h"
#include "manifold/support.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision.h>

namespace plumb::by_fcl {
namespace {

constexpr double kFaceToFace = 0.985;  ///< cosine between a normal and its triangle's

}  // namespace

struct Triangles::Scratch {
    fcl::CollisionRequestd request{1u << 20, false};
    fcl::CollisionResultd result;
    std::vector<std::uint32_t> near;  ///< triangles
    Part part;                        ///< one triangle, as a hull without thickness
    Vec3 corners[3];
};

Triangles::Triangles() : scratch_(std::make_unique<Scratch>()) {
    scratch_->request.gjk_solver_type = fcl::GST_LIBCCD;
    scratch_->part.shape.kind = ShapeKind::hull;
    scratch_->part.shape.vertices = scratch_->corners;
    scratch_->part.shape.vertex_count = 3;
    scratch_->part.faces = {{{}, {0, 1, 2}}, {{}, {0, 2, 1}}};
}
Triangles::~Triangles() = default;

/// The triangles that meet the part's own box, grown to the distance of detection.
void Triangles::find_near(const Part& mesh, const Part& convex) {
    Scratch& s = *scratch_;
    const Geometry &g = geometry_of(mesh), &c = geometry_of(convex);
    const double more = 2 * pair_margin(mesh, convex);
    const fcl::AABBd& own = c.shape->aabb_local;
    const fcl::Boxd box(own.max_ - own.min_ + fcl::Vector3d::Constant(more));
    const fcl::Transform3d place = c.place * fcl::Translation3d(own.center());
    s.result.clear();
    fcl::collide(g.shape.get(), g.place, &box, place, s.request, s.result);
    s.near.clear();
    for (std::size_t i = 0; i < s.result.numContacts(); ++i)
        s.near.push_back(static_cast<std::uint32_t>(s.result.getContact(i).b1));
    std::sort(s.near.begin(), s.near.end());
}

void Triangles::take_triangle(const Part& mesh, std::uint32_t index) {
    Scratch& s = *scratch_;
    Part& t = s.part;
    for (int i = 0; i < 3; ++i) s.corners[i] = mesh.shape.vertices[mesh.shape.faces[3 * index + i]];
    const Vec3 n = unit_or(cross(s.corners[1] - s.corners[0], s.corners[2] - s.corners[0]), {});
    t.faces[0].normal = n;
    t.faces[1].normal = -n;
    t.own_bounds = {s.corners[0], s.corners[0]};
    for (const Vec3& p : s.corners)
        for (int i = 0; i < 3; ++i) {
            at(t.own_bounds.low, i) = std::min(at(t.own_bounds.low, i), at(p, i));
            at(t.own_bounds.high, i) = std::max(at(t.own_bounds.high, i), at(p, i));
        }
    t.body = mesh.body;
    t.index = mesh.index != 0 ? mesh.index : index;
    t.world = mesh.world;
    t.reach = mesh.reach;
}

/// The triangle in the scratch part, which is a or b. Returns whether it is of the wanted sort.
bool Triangles::collide_one(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b,
                            bool faces) {
    const Part& t = scratch_->part;
    const Vec3 up = rotated(t.world, t.faces[0].normal);
    Witness witness;
    if (dot(up, up) < 0.5 || signed_distance(witness, a, b) != Answer::found) return false;
    const double along = dot(up, &a == &t ? -witness.normal : witness.normal);
    if (along < 0 || (along > kFaceToFace) != faces) return false;
    if (!faces && witness.gap > 0) return false;
    const std::size_t before = contacts.size();
    build_manifold(contacts, stats, a, b, witness);
    for (std::size_t i = before; i < contacts.size(); ++i)
        contacts.data()[i].flags |= kContactApproximate;
    return contacts.size() > before;
}

void Triangles::collide(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b) {
    const bool mesh_first = a.shape.kind == ShapeKind::mesh;
    const Part &mesh = mesh_first ? a : b, &convex = mesh_first ? b : a;
    find_near(mesh, convex);
    const std::size_t begin = contacts.size();
    DetectStats all{};
    for (const bool faces : {true, false}) {
        for (std::uint32_t index : scratch_->near) {
            take_triangle(mesh, index);
            const Part& t = scratch_->part;
            collide_one(contacts, all, mesh_first ? t : convex, mesh_first ? convex : t, faces);
        }
        if (contacts.size() > begin) break;
    }
    tidy_mesh_points(contacts, begin);
    stats.from_clip += contacts.size() - begin;
}

}  // namespace plumb::by_fcl
