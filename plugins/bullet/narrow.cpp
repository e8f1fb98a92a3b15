// SPDX-License-Identifier: MIT
/// Convex pairs: the closest-point query on cushioned shapes, which is exact to twelve digits;
/// boxes by Bullet's box detector, which is ten times as fast, on the true boxes where they overlap
/// and on larger ones where they do not. Meshes and height fields: the closest-point query for each
/// triangle; two meshes: shared code. Raw: every point of Bullet's algorithm as it comes, without
/// Bullet's cap of four and without history.
#include "bullet/narrow.h"

#include "manifold/gjk.h"
#include "manifold/least_overlap.h"
#include "manifold/mesh_pair.h"
#include "manifold/mesh_points.h"
#include "manifold/sharpen.h"
#include "manifold/support.h"

#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>

#include <mutex>

namespace plumb::bullet {
namespace {

constexpr bool kSingle = sizeof(btScalar) < sizeof(double);

bool is(const Part& part, ShapeKind kind) { return part.shape.kind == kind; }

/// Keeps the deepest point of an answer.
struct Deepest : btDiscreteCollisionDetectorInterface::Result {
    btVector3 normal, point;
    double depth = 1e300;
    void setShapeIdentifiersA(int, int) override {}
    void setShapeIdentifiersB(int, int) override {}
    void addContactPoint(const btVector3& n, const btVector3& on_b, btScalar distance) override {
        if (distance < depth) normal = n, point = on_b, depth = distance;
    }
};

/// Takes every point of an algorithm as it comes.
class Everything : public btManifoldResult {
public:
    struct Point {
        Vec3 normal, on_b;
        double distance;
        int index_a, index_b;
    };
    Everything(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
               double threshold)
        : btManifoldResult(a, b) {
        m_closestPointDistanceThreshold = threshold;
    }
    void addContactPoint(const btVector3& n, const btVector3& p, btScalar distance) override {
        // Algorithms of mixed kinds may have turned the pair round.
        const bool turned =
            m_manifoldPtr && m_manifoldPtr->getBody0() != m_body0Wrap->getCollisionObject();
        const Vec3 normal = turned ? -from(n) : from(n), point = from(p);
        points.push_back({normal, turned ? point + distance * from(n) : point, distance,
                          turned ? m_index1 : m_index0, turned ? m_index0 : m_index1});
    }
    std::vector<Point> points;
};

/// Bullet is asked in a frame whose origin is that of a, so that its precision does not depend on
/// where in the world a pair is.
btTransform place_in_pair(const Part& part, const Part& a) {
    return btTransform(shapes_of(part).turn, bt(part.world.origin - a.world.origin));
}
Vec3 to_world(const btVector3& p, const Part& a) { return from(p) + a.world.origin; }

btDiscreteCollisionDetectorInterface::ClosestPointInput input_of(const Part& a, const Part& b,
                                                                 double reach) {
    btDiscreteCollisionDetectorInterface::ClosestPointInput input;
    input.m_transformA = place_in_pair(a, a);
    input.m_transformB = place_in_pair(b, a);
    input.m_maximumDistanceSquared = bt(reach * reach);
    return input;
}

/// Overlapping parts that Bullet leaves out or gets wrong: the closest points of the parts a little
/// smaller, or the direction of least overlap. False where the parts are apart after all.
bool ask_gjk(Witness& witness, const Part& a, const Part& b) {
    const bool apart = closest_when_apart(witness, a, b);
    if (!apart && !closest_when_touching(witness, a, b)) witness = least_overlap(a, b);
    witness.shared = true;
    return !apart || witness.gap <= pair_margin(a, b);
}

}  // namespace

Narrow::Narrow() {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
    scratch_.triangle.backend = make_triangle();
}

bool Narrow::ask_boxes(Witness& witness, const Part& a, const Part& b, bool grown) {
    const Shapes &sa = shapes_of(a), &sb = shapes_of(b);
    btBoxBoxDetector detector(grown ? sa.grown_box.get() : sa.exact_box.get(),
                              grown ? sb.grown_box.get() : sb.exact_box.get());
    Deepest result;
    detector.getClosestPoints(input_of(a, b, 1e9), result, nullptr);
    if (result.depth > 1e299) return false;
    witness = {from(result.normal), to_world(result.point, a),
               result.depth + (grown ? pair_margin(a, b) : 0), false};
    if (kSingle) sharpen(witness, a, b);
    return true;
}

bool Narrow::ask_closest(Witness& witness, const Part& a, const Part& b) {
    const Shapes &sa = shapes_of(a), &sb = shapes_of(b);
    const double margins = sa.cushioned->getMargin() + sb.cushioned->getMargin();
    const double cushions = sa.cushion + sb.cushion;
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver penetration;
    btGjkPairDetector detector(sa.cushioned.get(), sb.cushioned.get(), &simplex, &penetration);
    const Vec3 first_guess = unit_or(a.world.origin - b.world.origin, {0, 1, 0});
    detector.setCachedSeparatingAxis(bt(first_guess));
    Deepest result;
    detector.getClosestPoints(input_of(a, b, margins + pair_margin(a, b) + cushions), result,
                              nullptr);
    if (result.depth > 1e299) return false;
    const Vec3 n = from(result.normal);
    witness = {n, to_world(result.point, a) + (0.5 * result.depth) * n, result.depth + cushions,
               false};
    kSingle ? sharpen(witness, a, b) : sharpen_bent(witness, a, b);
    return true;
}

bool Narrow::ask(Witness& witness, const Part& a, const Part& b) {
    if (is(a, ShapeKind::box) && is(b, ShapeKind::box)) {
        if (ask_boxes(witness, a, b, false)) return true;
        if (!ask_boxes(witness, a, b, true)) return false;
        if (gap_is_reached(a, b, witness.normal)) return true;
    }
    if (!ask_closest(witness, a, b)) {
        // Nothing near, unless the cores coincide: such pairs Bullet leaves out.
        return !axes_part(a, b) && ask_gjk(witness, a, b);
    }
    // An answer that its own normal contradicts is not trusted.
    const double implied = support_gap(a, b, unit_or(witness.normal, {0, 1, 0}));
    if (implied > witness.gap - 1e-4 * (size_of(a) + size_of(b))) return true;
    Witness other;
    witness.approximate = true;
    if (ask_gjk(other, a, b) && support_gap(a, b, other.normal) > implied) witness = other;
    return true;
}

bool Narrow::ask(Witness& witness, const Part& a, const Part& b, std::uint32_t) {
    fit_triangle(scratch_.triangle);
    return ask(witness, a, b);
}

void Narrow::collide_convex(ContactList& contacts, DetectStats& stats, const Part& a,
                            const Part& b) {
    // A half-space needs no question: its normal is the contact's.
    const bool plane = is(a, ShapeKind::plane) || is(b, ShapeKind::plane);
    Witness witness{{0, 1, 0}, is(a, ShapeKind::plane) ? b.world.origin : a.world.origin, 0, false};
    if (plane || ask(witness, a, b)) build_manifold(contacts, stats, a, b, witness);
}

void Narrow::collide_raw(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b) {
    const Shapes &sa = shapes_of(a), &sb = shapes_of(b);
    const bool boxes = sa.exact_box && sb.exact_box;
    btCollisionShape* shape_a = boxes ? sa.exact_box.get() : sa.any();
    btCollisionShape* shape_b = boxes ? sb.exact_box.get() : sb.any();
    const double cushions =
        boxes ? 0 : (sa.cushioned ? sa.cushion : 0) + (sb.cushioned ? sb.cushion : 0);

    btCollisionObject object_a, object_b;
    object_a.setCollisionShape(shape_a);
    object_b.setCollisionShape(shape_b);
    object_a.setWorldTransform(place_in_pair(a, a));
    object_b.setWorldTransform(place_in_pair(b, a));
    const btCollisionObjectWrapper wrap_a(nullptr, shape_a, &object_a, object_a.getWorldTransform(),
                                          -1, -1);
    const btCollisionObjectWrapper wrap_b(nullptr, shape_b, &object_b, object_b.getWorldTransform(),
                                          -1, -1);
    // Bullet counts who uses a mesh in the mesh itself.
    static std::mutex mesh_lock;
    const auto guard = has_surface(a.shape.kind) || has_surface(b.shape.kind)
                           ? std::unique_lock(mesh_lock)
                           : std::unique_lock<std::mutex>();
    btCollisionAlgorithm* algorithm =
        dispatcher_.findAlgorithm(&wrap_a, &wrap_b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    if (!algorithm) return;
    Everything result(&wrap_a, &wrap_b, pair_margin(a, b));
    algorithm->processCollision(&wrap_a, &wrap_b, btDispatcherInfo(), &result);
    algorithm->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm);

    for (const Everything::Point& p : result.points) {
        const bool mesh_a = has_surface(a.shape.kind), mesh_b = has_surface(b.shape.kind);
        const auto ta = mesh_a && p.index_a >= 0 ? static_cast<std::uint32_t>(p.index_a) : 0;
        const auto tb = mesh_b && p.index_b >= 0 ? static_cast<std::uint32_t>(p.index_b) : 0;
        const Witness w{p.normal, p.on_b + a.world.origin + (0.5 * p.distance) * p.normal,
                        p.distance + cushions, mesh_a || mesh_b};
        const std::size_t before = contacts.size();
        add_raw(contacts, stats, a, b, w, w.approximate ? feature_key({ta, tb}) : 0);
        if (contacts.size() == before) continue;
        Contact& c = contacts.data()[before];
        if (mesh_a && a.index == 0) c.part_a = ta;
        if (mesh_b && b.index == 0) c.part_b = tb;
        anchor_sphere(c, a, b);
    }
}

void Narrow::collide_mesh(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b) {
    if (is(a, ShapeKind::plane) || is(b, ShapeKind::plane))
        return mesh_on_plane(contacts, stats, a, b);
    if (!has_surface(a.shape.kind) || !has_surface(b.shape.kind))
        return collide_triangles(contacts, stats, a, b, *this, scratch_);
    collide_meshes(contacts, stats, a, b);
}

}  // namespace plumb::bullet
