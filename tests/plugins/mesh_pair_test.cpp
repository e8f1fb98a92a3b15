// SPDX-License-Identifier: MIT
/// Two meshes: depths against exact separating axes of the same polyhedra as hulls, and against
/// closed forms; apart, touching and overlapping, large and small.
#include "exact.h"
#include "surfaces.h"

namespace plumb::test {
namespace {

const double kGaps[] = {.009, .005, .001, 0., -.0005, -.002, -.005};

class MeshPairs : public EachPlugin {
protected:
    bool can() const { return claims(ShapeKind::mesh, ShapeKind::mesh, kPairSeparated); }

    std::vector<Contact> meet(const Shape& lower, const Place& p, const Shape& upper,
                              const Place& q, double margin = kMargin) const {
        World world(GetParam());
        world.add(1, lower, p, Mobility::fixed);
        world.add(2, upper, q);
        const auto& contacts = world.detect(margin);
        EXPECT_EQ(world.status().code, Status::ok);
        expect_sound(contacts, margin);
        return contacts;
    }
};

Q turn(double degrees, const V& axis) {
    return Q(Eigen::AngleAxisd(degrees * M_PI / 180, axis.normalized()));
}

/// The triangles of a convex mesh as a hull.
Shape hull_of_mesh(const Shape& mesh) {
    std::vector<V> vertices;
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::uint32_t i = 0; i < mesh.vertex_count; ++i) vertices.push_back(v(mesh.vertices[i]));
    for (std::uint32_t f = 0; f < mesh.face_count; ++f)
        if (v(mesh.face_normals[f]).norm() > .5)  // not those at a pole, which have no area
            faces.push_back({mesh.faces[3 * f], mesh.faces[3 * f + 1], mesh.faces[3 * f + 2]});
    return hull(vertices, faces);
}

TEST_P(MeshPairs, StandOnEachOtherAsBoxesDo) {
    if (!can()) return;
    for (double size : {1., .001, 50.})
        for (int cells : {1, 5})
            for (double gap : kGaps)
                for (double spin : {0., 20., 45.}) {
                    SCOPED_TRACE(std::to_string(size) + " m, gap " + std::to_string(gap) +
                                 ", turned by " + std::to_string(spin));
                    const Place top{V(.03, .8 + gap, -.02) * size, turn(spin, V::UnitY())};
                    const auto contacts = meet(cube_mesh(.5 * size, cells), {},
                                               cube_mesh(.3 * size, cells), top, kMargin * size);
                    ASSERT_GE(contacts.size(), 4u);
                    EXPECT_LE(contacts.size(), 8u);
                    EXPECT_NEAR(spanned_area(contacts), .36 * size * size, 1e-6 * size * size);
                    for (const Contact& c : contacts) {
                        EXPECT_NEAR(c.gap, gap * size, 1e-7 * size);
                        EXPECT_NEAR(c.normal.y, -1, 1e-9);
                    }
                }
}

TEST_P(MeshPairs, OverhangAsBoxesDo) {
    if (!can()) return;
    for (double spin : {0., 20.})
        for (double gap : kGaps) {
            SCOPED_TRACE("gap " + std::to_string(gap) + ", turned by " + std::to_string(spin));
            const Place top{V(.5, .8 + gap, .1), turn(spin, V::UnitY())};
            const auto contacts = meet(box_mesh(.5, .5, .5), {}, box_mesh(.3, .3, .3), top);
            const auto boxes = [&] {
                World world(GetParam());
                world.add(1, box(.5, .5, .5), {}, Mobility::fixed);
                world.add(2, box(.3, .3, .3), top);
                return world.detect(kMargin);
            }();
            ASSERT_FALSE(contacts.empty());
            EXPECT_NEAR(spanned_area(contacts), spanned_area(boxes), 1e-6);
            for (const Contact& c : contacts) {
                EXPECT_NEAR(c.gap, gap, 1e-7);
                EXPECT_NEAR(c.normal.y, -1, 1e-9);
            }
        }
}

TEST_P(MeshPairs, AgreeWithSeparatingAxes) {
    if (!can()) return;
    const Shape cube = box_mesh(.5, .4, .3), gem = sphere_mesh(.4, 3);
    const Shape shapes[] = {cube, gem}, hulls[] = {box_hull(.5, .4, .3), hull_of_mesh(gem)};
    for (int i = 0; i < 80; ++i) {
        const int p = i % 2, q = i / 2 % 2;
        const Q spun = turn(37 * i, V(1, .3 * (i % 7), .2 * (i % 5) - .3)),
                other = turn(53 * i, V(.2 * (i % 3), 1, .3 * (i % 4) - .5));
        const V way = turn(137.5 * i, V::UnitY()) * turn(1.7 * i, V::UnitX()) * V::UnitY();
        // Moved together until the axes say the gap that is asked for.
        const double wanted = -.0005 * (i % 11);
        double low = 0, high = 2;
        for (int step = 0; step < 25; ++step) {
            const double middle = .5 * (low + high);
            const double gap =
                separating_axes(hulls[p], {V::Zero(), spun}, hulls[q], {middle * way, other}).gap;
            (gap < wanted ? low : high) = middle;
        }
        SCOPED_TRACE("pose " + std::to_string(i) + ", gap " + std::to_string(wanted));
        const auto contacts = meet(shapes[p], {V::Zero(), spun}, shapes[q], {low * way, other});
        ASSERT_FALSE(contacts.empty());
        const double truth =
            separating_axes(hulls[p], {V::Zero(), spun}, hulls[q], {low * way, other}).gap;
        EXPECT_NEAR(deepest(contacts).gap, truth, 1e-6);
    }
}

TEST_P(MeshPairs, OfSpheresAreAsDeepAsTheirPolyhedra) {
    if (!can()) return;
    const Shape ball = sphere_mesh(.5, 16);
    for (int i = 0; i < 30; ++i)
        for (double gap : {.004, 0., -.005}) {
            const V way = turn(137.5 * i, V::UnitY()) * turn(5 * i, V::UnitX()) * V::UnitY();
            const Q spun = turn(29 * i, V(1, 2, -1));
            // The widest support gap over a cone of directions about the line of centres.
            const Place home{}, there{(1 + gap) * way, spun};
            const double truth =
                widest_gap(hull_of_mesh(ball), home, hull_of_mesh(ball), there).gap;
            SCOPED_TRACE("pose " + std::to_string(i) + ", gap " + std::to_string(truth));
            const auto contacts = meet(ball, home, ball, there, .05);
            ASSERT_FALSE(contacts.empty());
            EXPECT_NEAR(deepest(contacts).gap, truth, 1e-4);
            EXPECT_LT(v(deepest(contacts).normal).dot(way), -std::cos(M_PI / 16));
        }
}

TEST_P(MeshPairs, LayABoxOnATorusAndATorusOnABox) {
    if (!can()) return;
    for (double size : {1., .001})
        for (double gap : kGaps)
            for (bool ring_above : {true, false}) {
                SCOPED_TRACE("gap " + std::to_string(gap) + (ring_above ? "" : ", ring below"));
                const Shape ring_here = torus_mesh(.5 * size, .2 * size, 48, 24);
                const Shape slab_here = cube_mesh(.9 * size, 3);
                const Place top{V(.01, 1.1 + gap, -.02) * size, turn(11, V::UnitY())};
                const auto contacts = ring_above
                                          ? meet(slab_here, {}, ring_here, top, kMargin * size)
                                          : meet(ring_here, {}, slab_here, top, kMargin * size);
                ASSERT_GE(contacts.size(), 4u);
                EXPECT_NEAR(deepest(contacts).gap, gap * size, 1e-6 * size);
                EXPECT_GT(spanned_area(contacts), .5 * size * size);
                for (const Contact& c : contacts) EXPECT_LT(c.normal.y, -std::cos(.01));
            }
}

TEST_P(MeshPairs, KeepBothNormalsOfACorner) {
    if (!can()) return;
    // A block against a wall and a floor of one closed mesh, 2 and 4 mm deep.
    const std::vector<V> outline = {V(0, 0, 0),     V(1, 0, 0),   V(1, -.5, 0),
                                    V(-.5, -.5, 0), V(-.5, 1, 0), V(0, 1, 0)};
    std::vector<V> vertices;
    for (double z : {-1., 1.})
        for (const V& p : outline) vertices.push_back(p + V(0, 0, z));
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t j = (i + 1) % 6;
        triangles.push_back({i, i + 6, j});
        triangles.push_back({j, i + 6, j + 6});
    }
    for (const Triangle& t : {Triangle{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
        triangles.push_back(t);
        triangles.push_back({t[0] + 6, t[2] + 6, t[1] + 6});
    }
    const auto contacts = meet(mesh(vertices, triangles), {}, box_mesh(.2, .2, .2),
                               {V(.198, .196, .1), Q::Identity()});
    double wall = 0, floor = 0;
    for (const Contact& c : contacts) {
        if (c.normal.x < -.99) wall = std::min(wall, c.gap);
        if (c.normal.y < -.99) floor = std::min(floor, c.gap);
    }
    EXPECT_NEAR(wall, -.002, 1e-7);
    EXPECT_NEAR(floor, -.004, 1e-7);
}

PLUMB_FOR_EACH_PLUGIN(MeshPairs);

}  // namespace
}  // namespace plumb::test
