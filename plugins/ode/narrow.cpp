// SPDX-License-Identifier: MIT
/// ODE answers only where shapes overlap. So: round shapes are asked in their wide form, which is
/// exact; boxes are asked again a little larger where they do not overlap; and where that does not
/// settle it (an edge or a vertex in front of something sharp), the closest points of the true
/// shapes are computed beside ODE. Meshes and height fields are walked through triangle by
/// triangle.
#include "ode/narrow.h"

#include "manifold/boxes_apart.h"
#include "manifold/gjk.h"
#include "manifold/least_overlap.h"
#include "manifold/mesh_pair.h"
#include "manifold/mesh_points.h"
#include "manifold/sharpen.h"
#include "manifold/support.h"

#include <mutex>
#include <stdexcept>

namespace plumb::ode {
namespace {

constexpr int kMostFromOde = 512;
constexpr double kDeep =
    0.01;  ///< overlap, as a share of size, that is compared with other ways out

bool is(const Part& part, ShapeKind kind) { return part.shape.kind == kind; }

Witness witness_of(const dContactGeom& c, double wider_by) {
    return {{c.normal[0], c.normal[1], c.normal[2]},
            {c.pos[0], c.pos[1], c.pos[2]},
            wider_by - c.depth,
            false};
}

double widened(const Part& part) { return geoms_of(part).wide ? geoms_of(part).wider_by : 0; }

/// ODE's points; none where it gives up, as now and then on cylinders with one axis.
int collide_or_none(dGeomID a, dGeomID b, int most, dContactGeom* c) {
    try {
        return dCollide(a, b, most, c, sizeof(dContactGeom));
    } catch (const std::runtime_error&) {
        return 0;
    }
}

/// ODE's deepest point; false where it has none. A round shape is asked wide, but only one of two.
bool ask(Witness& witness, const Part& a, const Part& b) {
    const bool widen_a = geoms_of(a).wide != nullptr;
    dContactGeom c[16];
    const int count = collide_or_none(geoms_of(a).widest(),
                                      widen_a ? geoms_of(b).exact : geoms_of(b).widest(), 16, c);
    if (count < 1) return false;
    int best = 0;
    for (int i = 1; i < count; ++i)
        if (c[i].depth > c[best].depth) best = i;
    witness = witness_of(c[best], widen_a ? widened(a) : widened(b));
    return true;
}

/// ODE's box against box with all half extents grown by `grown`.
bool ask_boxes(Witness& witness, const Part& a, const Part& b, double grown) {
    const auto sides = [grown](const Part& p, dVector3 s) {
        const Vec3& h = p.shape.half_extents;
        s[0] = 2 * (h.x + grown), s[1] = 2 * (h.y + grown), s[2] = 2 * (h.z + grown);
    };
    dVector3 side_a, side_b, normal;
    sides(a, side_a);
    sides(b, side_b);
    dContactGeom c[8];
    dReal depth = 0;
    int code = 0;
    const int count =
        dBoxBox(dGeomGetPosition(geoms_of(a).exact), dGeomGetRotation(geoms_of(a).exact), side_a,
                dGeomGetPosition(geoms_of(b).exact), dGeomGetRotation(geoms_of(b).exact), side_b,
                normal, &depth, &code, 1, c, sizeof(dContactGeom));
    // Without a code an axis parts the boxes. With one there is a normal, even where ODE's own
    // clipping lost the points.
    if (code == 0) return false;
    const Vec3 middle = 0.5 * (a.world.origin + b.world.origin);
    const Vec3 point = count > 0 ? Vec3{c[0].pos[0], c[0].pos[1], c[0].pos[2]} : middle;
    witness = {{-normal[0], -normal[1], -normal[2]}, point, 2 * grown - depth, false};
    return true;
}

/// The closest points of sharp parts that ODE says nothing about: apart, or just touching.
bool ask_gjk(Witness& witness, const Part& a, const Part& b) {
    const bool found = closest_when_apart(witness, a, b) || closest_when_touching(witness, a, b);
    witness.shared = true;
    return found;
}

/// The gap that supports imply along the normal of a witness [m].
double implied_gap(const Witness& witness, const Part& a, const Part& b) {
    return support_gap(a, b, unit_or(witness.normal, {0, 1, 0}));
}

/// ODE can name a normal along which the true shapes overlap far more than it says: its convex test
/// often, its box test where two edges are nearly parallel. Then GJK is
/// asked, too, and of both normals the one of less overlap is nearer to the truth. Returns the gap
/// that it implies [m].
double validate_normal(Witness& witness, const Part& a, const Part& b) {
    const double implied = implied_gap(witness, a, b);
    if (implied > witness.gap - 1e-4 * (size_of(a) + size_of(b))) return implied;
    Witness other;
    witness.approximate = true;
    if (!ask_gjk(other, a, b) || !(support_gap(a, b, other.normal) > implied)) return implied;
    witness = other;
    return implied_gap(witness, a, b);
}

/// ODE's convex test stops at some way out of an overlap, which need not be the shortest. Where
/// parts overlap little, their cores or the parts a little smaller are apart, and their closest
/// points show a shorter one. Takes and returns the gap that the witness implies [m].
double shorten(Witness& witness, const Part& a, const Part& b, double implied) {
    Witness other;
    if (!ask_gjk(other, a, b) || !(other.gap > implied)) return implied;
    witness = other;
    return implied_gap(witness, a, b);
}

/// Parts that overlap far, of which ODE may have named a long way out, or none at all: the
/// shortest, if it is shorter than the gap that the witness implies [m].
bool ask_deep(Witness& witness, const Part& a, const Part& b, double implied) {
    const double size = size_of(a) + size_of(b);
    if (implied > -kDeep * size || axes_part(a, b)) return false;
    const Witness other = least_overlap(a, b);
    if (other.gap > implied + 1e-5 * size) witness = other;
    return true;
}

constexpr double kNoWayOut = -1e300;

bool ask_any(Witness& witness, const Part& a, const Part& b) {
    if (ask(witness, a, b)) {
        double implied = validate_normal(witness, a, b);
        if (is(a, ShapeKind::hull) || is(b, ShapeKind::hull))
            implied = shorten(witness, a, b, implied);
        ask_deep(witness, a, b, implied);
    } else if (!ask_gjk(witness, a, b) && !ask_deep(witness, a, b, kNoWayOut)) {
        return false;
    }
    sharpen_bent(witness, a, b);
    return true;
}

/// Boxes that an axis parts: the normal of larger boxes will do where it parts the true ones too,
/// and two points of them reach the gap that it implies. Where an edge of one is all but parallel
/// to one of the other, ODE takes boxes for parted along their product, which is rounding alone: no
/// axis of a face parts those.
void collide_boxes(Output out, const Part& a, const Part& b) {
    const double margin = pair_margin(a, b);
    if (faces_part_boxes(a, b, margin)) return;
    Witness witness;
    if (ask_boxes(witness, a, b, 0)) {
        validate_normal(witness, a, b);
    } else if (ask_boxes(witness, a, b, 0.5 * margin)) {
        const Vec3 n = unit_or(witness.normal, {0, 1, 0});
        const double gap = support_gap(a, b, n);
        if (gap > margin) return;  // no way between them is shorter
        if (gap >= 0 && build_where_reached(out.contacts, out.stats, a, b, n, gap)) return;
        if (!ask_gjk(witness, a, b)) return;
    } else {
        if (axes_part(a, b, margin)) return;
        if (!ask_gjk(witness, a, b) && !ask_deep(witness, a, b, kNoWayOut)) return;
    }
    build_manifold(out.contacts, out.stats, a, b, witness);
}

bool is_plane_pair(const Part& a, const Part& b) {
    return is(a, ShapeKind::plane) || is(b, ShapeKind::plane);
}

/// Index of the part's triangle in an answer of ODE.
std::uint32_t triangle(const Part& part, int side) {
    return has_surface(part.shape.kind) && side >= 0 ? static_cast<std::uint32_t>(side) : 0;
}

/// ODE's meshes share scratch memory over the whole process.
std::mutex& mesh_lock() {
    static std::mutex lock;
    return lock;
}

void add_all(Output out, const Part& a, const Part& b, const dContactGeom* c, int count,
             double wider_by) {
    const bool compound_part_a = a.index != 0, compound_part_b = b.index != 0;
    for (int i = 0; i < count; ++i) {
        Witness w = witness_of(c[i], wider_by);
        w.approximate = has_surface(a.shape.kind) || has_surface(b.shape.kind);
        const std::uint32_t ta = triangle(a, c[i].side1), tb = triangle(b, c[i].side2);
        const std::size_t before = out.contacts.size();
        add_raw(out.contacts, out.stats, a, b, w, w.approximate ? feature_key({ta, tb}) : 0);
        if (out.contacts.size() == before) continue;
        Contact& added = out.contacts.data()[before];
        if (!compound_part_a && has_surface(a.shape.kind)) added.part_a = ta;
        if (!compound_part_b && has_surface(b.shape.kind)) added.part_b = tb;
        anchor_sphere(added, a, b);
    }
}

}  // namespace

void TriangleAnswers::begin(const Part& a, const Part& b) {
    named_.clear();
    if (is(a, ShapeKind::hull) || is(b, ShapeKind::hull)) return;
    const std::lock_guard<std::mutex> guard(mesh_lock());
    static dContactGeom c[kMostFromOde];  // behind the lock
    const int count =
        dCollide(geoms_of(a).widest(), geoms_of(b).widest(), kMostFromOde, c, sizeof(dContactGeom));
    const bool mesh_first = has_surface(a.shape.kind);
    for (int i = 0; i < count; ++i)
        named_.push_back({mesh_first ? triangle(a, c[i].side1) : triangle(b, c[i].side2),
                          witness_of(c[i], std::max(widened(a), widened(b)))});
    std::sort(named_.begin(), named_.end(), [](const Named& p, const Named& q) {
        return p.id != q.id ? p.id < q.id : p.witness.gap < q.witness.gap;
    });
    const auto same = [](const Named& p, const Named& q) { return p.id == q.id; };
    named_.erase(std::unique(named_.begin(), named_.end(), same), named_.end());
}

bool TriangleAnswers::ask(Witness& witness, const Part& a, const Part& b, std::uint32_t id) {
    const bool found = find(witness, a, b, id);
    if (found) sharpen_bent(witness, a, b);
    return found;
}

bool TriangleAnswers::find(Witness& witness, const Part& a, const Part& b, std::uint32_t id) const {
    const auto it = std::lower_bound(named_.begin(), named_.end(), id,
                                     [](const Named& n, std::uint32_t i) { return n.id < i; });
    if (it == named_.end() || it->id != id) return ask_gjk(witness, a, b);
    witness = it->witness;
    if (!finite(witness.normal)) return ask_gjk(witness, a, b);

    // A normal along which the true shapes overlap more than ODE says is not trusted.
    const double implied = implied_gap(witness, a, b);
    if (implied > witness.gap - 1e-6 * (size_of(a) + size_of(b))) return true;
    Witness other;
    if (ask_gjk(other, a, b) && support_gap(a, b, other.normal) > implied) witness = other;
    return true;
}

void collide_convex(Output out, const Part& a, const Part& b) {
    if (is(a, ShapeKind::box) && is(b, ShapeKind::box)) return collide_boxes(out, a, b);
    // A half-space needs no question: its normal is the contact's.
    Witness witness{{0, 1, 0}, is(a, ShapeKind::plane) ? b.world.origin : a.world.origin, 0, false};
    if (is_plane_pair(a, b) || ask_any(witness, a, b))
        build_manifold(out.contacts, out.stats, a, b, witness);
}

void collide_mesh(Output out, const Part& a, const Part& b, Workspace& workspace) {
    if (is_plane_pair(a, b)) return mesh_on_plane(out.contacts, out.stats, a, b);
    if (!has_surface(a.shape.kind) || !has_surface(b.shape.kind))
        return collide_triangles(out.contacts, out.stats, a, b, workspace.answers,
                                 workspace.scratch);
    collide_meshes(out.contacts, out.stats, a, b);
}

void collide_raw(Output out, const Part& a, const Part& b) {
    const std::lock_guard<std::mutex> guard(mesh_lock());
    static dContactGeom c[kMostFromOde];  // behind the lock
    const int count =
        dCollide(geoms_of(a).exact, geoms_of(b).exact, kMostFromOde, c, sizeof(dContactGeom));
    add_all(out, a, b, c, count, 0);
}

}  // namespace plumb::ode
