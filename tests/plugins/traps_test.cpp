// SPDX-License-Identifier: MIT
/// Traps that back-ends are known for, one test each: a right answer, or none that was claimed.
#include "math/rotation_between.h"
#include "population.h"
#include "surfaces.h"

#include <atomic>
#include <thread>

namespace plumb::test {
namespace {

class Traps : public EachPlugin {
protected:
    /// All contacts of two bodies, the first fixed.
    std::vector<Contact> meet(const Shape& lower, const Place& at_lower, const Shape& upper,
                              const Place& at_upper, double margin = 0.01) const {
        World world(GetParam());
        world.add(1, lower, at_lower, Mobility::fixed);
        world.add(2, upper, at_upper);
        return world.detect(margin);
    }

    /// Checks that one of the contacts has this gap and none is deeper.
    void expect_gap(const std::vector<Contact>& contacts, double gap) const {
        ASSERT_FALSE(contacts.empty());
        EXPECT_NEAR(deepest(contacts).gap, gap, relative_accuracy(GetParam()));
    }
};

const Q kOnEdge(Eigen::AngleAxisd(M_PI / 4, V::UnitX()));
const Q kOnVertex = rotation_between(V(1, 1, 1).normalized(), -V::UnitY());
const double kEdge = std::sqrt(0.5), kVertex = std::sqrt(0.75);  ///< of a unit cube [m]
const Place kTop{V(0, -.5, 0), Q::Identity()};

TEST_P(Traps, HullsOnHalfSpacesDoNotCrash) {
    PLUMB_NEEDS_CLAIM(ShapeKind::plane, ShapeKind::hull, kPairSeparated);
    for (double gap : {0.005, 0.0, -0.01, -0.3})
        expect_gap(meet(plane(), {}, octahedron(.5), {V(0, .5 + gap, 0), Q::Identity()}), gap);
}

TEST_P(Traps, HullsHaveNoCushion) {
    PLUMB_NEEDS_CLAIM(ShapeKind::hull, ShapeKind::hull, kPairSeparated);
    const Shape cube = box_hull(.5, .5, .5);
    for (double gap : {0.08, 0.04, 0.02})
        EXPECT_TRUE(meet(cube, kTop, cube, {V(0, .5 + gap, 0), Q::Identity()}).empty()) << gap;
    for (double gap : {0.005, -0.01})
        expect_gap(meet(cube, kTop, cube, {V(0, .5 + gap, 0), Q::Identity()}), gap);
}

TEST_P(Traps, TheFirstCallFindsAllFourCorners) {
    for (const Shape& cube : {box(.5, .5, .5), box_hull(.5, .5, .5)}) {
        if (!claims(cube, cube, kPairManifold)) continue;
        EXPECT_GE(meet(cube, kTop, cube, {V(0, .49, 0), Q::Identity()}).size(), 4u);
    }
}

TEST_P(Traps, AVertexIsAsDeepAsItIs) {
    for (const Shape& cube : {box(.5, .5, .5), box_hull(.5, .5, .5)}) {
        if (!claims(cube, cube)) continue;
        expect_gap(meet(cube, kTop, cube, {V(.03, kVertex - .01, .02), kOnVertex}), -.01);
    }
}

TEST_P(Traps, EdgesAndVerticesApartAreNotRounded) {
    for (const Shape& cube : {box(.5, .5, .5), box_hull(.5, .5, .5)}) {
        if (!claims(cube, cube, kPairSeparated)) continue;
        expect_gap(meet(cube, kTop, cube, {V(.03, kEdge + .005, .02), kOnEdge}), .005);
        expect_gap(meet(cube, kTop, cube, {V(.03, kVertex + .005, .02), kOnVertex}), .005);
        // Vertex to vertex along the diagonal of both: nothing but the corners is near.
        const V corner = V(.5, .5, .5) + .004 * V(1, 1, 1).normalized();
        const Place beyond{corner + V(.5, .5, .5), Q::Identity()};
        expect_gap(meet(cube, {}, cube, beyond), .004);
    }
}

TEST_P(Traps, HullsNeedNotSurroundTheirOrigin) {
    PLUMB_NEEDS_CLAIM(ShapeKind::hull, ShapeKind::plane);
    const V off(5, 3, -2);
    std::vector<V> corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back(off + V(i & 1 ? .5 : -.5, i & 2 ? .5 : -.5, i & 4 ? .5 : -.5));
    const Shape aside =
        hull(corners,
             {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
    for (const Shape& floor : {plane(), box(2, .5, 2), box_hull(2, .5, 2)}) {
        if (!claims(floor, aside)) continue;
        const Place ground = floor.kind == ShapeKind::plane ? Place{} : kTop;
        const auto contacts = meet(floor, ground, aside, {V(0, .49, 0) - off, Q::Identity()});
        SCOPED_TRACE(name_of(floor.kind));
        expect_gap(contacts, -.01);
        if (claims(floor, aside, kPairManifold)) {
            EXPECT_NEAR(spanned_area(contacts), 1, 0.01);
        }
    }
}

TEST_P(Traps, HullsOnMeshesAreNeverSilent) {
    PLUMB_NEEDS_CLAIM(ShapeKind::hull, ShapeKind::mesh);
    const Place at{V(.1, .495, .05), Q::Identity()};
    EXPECT_FALSE(meet(grid_mesh(2, 4), {}, box_hull(.5, .5, .5), at).empty());
}

/// What rests flat on a mesh, each with its bottom at y = 0.
std::vector<std::pair<Shape, Place>> flat_on_meshes() {
    const Q lying(Eigen::AngleAxisd(M_PI / 2, V::UnitZ())), level = Q::Identity();
    return {{sphere(.3), {V(.11, .3, .07), level}},
            {box(.3, .2, .25), {V(.11, .2, .07), Q(Eigen::AngleAxisd(.3, V::UnitY()))}},
            {capsule(.2, .3), {V(.11, .2, .07), lying}},
            {cylinder(.3, .2), {V(.11, .2, .07), level}},
            {cone(.3, .2), {V(.11, .2, .07), level}},
            {box_hull(.3, .2, .25), {V(.11, .2, .07), level}}};
}

TEST_P(Traps, NormalsLeaveAMeshWhicheverIdComesFirst) {
    for (auto [shape, at] : flat_on_meshes())
        for (bool mesh_first : {true, false}) {
            if (!claims(ShapeKind::mesh, shape.kind)) continue;
            SCOPED_TRACE(std::string(name_of(shape.kind)) + (mesh_first ? "" : ", mesh second"));
            World world(GetParam());
            world.add(mesh_first ? 1 : 2, cube_mesh(1, 4), {V(0, -1, 0), Q::Identity()},
                      Mobility::fixed);
            world.add(mesh_first ? 2 : 1, shape, {at.x - V(0, .01, 0), at.q});
            expect_gap(world.detect(.01), -.01);
            for (const Contact& c : world.last())
                EXPECT_NEAR(c.normal.y, mesh_first ? -1 : 1, 1e-6);
        }
}

TEST_P(Traps, RawNormalsLeaveAMeshWhicheverIdComesFirst) {
    PLUMB_NEEDS_CLAIM(ShapeKind::mesh, ShapeKind::sphere);
    for (bool mesh_first : {true, false}) {
        World world(GetParam());
        world.add(mesh_first ? 1 : 2, cube_mesh(1, 4), {V(0, -1, 0), Q::Identity()},
                  Mobility::fixed);
        world.add(mesh_first ? 2 : 1, sphere(.3), {V(.11, .29, .07), Q::Identity()});
        const auto& contacts = world.detect(.01, kDetectRaw);
        ASSERT_FALSE(contacts.empty());
        EXPECT_NEAR(deepest(contacts).gap, -.01, 2e-3);
        EXPECT_NEAR(deepest(contacts).normal.y, mesh_first ? -1 : 1, 1e-3);
    }
}

TEST_P(Traps, RawQuestionsAboutHalfSpacesDoNotCrash) {
    for (const Shape& shape : {box_hull(.5, .5, .5), box_mesh(.5, .5, .5), box(.5, .5, .5)})
        for (const auto& [q, low] :
             {std::pair{Q::Identity(), .5}, {kOnEdge, kEdge}, {kOnVertex, kVertex}})
            for (double gap : {.3, .005, -.01, -.4})
                for (bool plane_first : {true, false}) {
                    if (!claims(ShapeKind::plane, shape.kind)) continue;
                    SCOPED_TRACE(std::string(name_of(shape.kind)) + " at " + std::to_string(gap));
                    World world(GetParam());
                    world.add(plane_first ? 1 : 2, plane(), {}, Mobility::fixed);
                    world.add(plane_first ? 2 : 1, shape, {V(0, low + gap, 0), q});
                    const auto& contacts = world.detect(.01, kDetectRaw);
                    EXPECT_EQ(world.status().code, Status::ok);
                    if (gap > 0) continue;  // what a back-end says of bodies apart is its own
                    ASSERT_FALSE(contacts.empty());
                    EXPECT_NEAR(deepest(contacts).gap, gap, 2e-3);
                }
}

TEST_P(Traps, EveryPointOfABoxOnAMeshIsPushedUp) {
    for (const Shape& cube : {box(.5, .5, .5), box_hull(.5, .5, .5)})
        for (double turn : {0., .3, M_PI / 4}) {
            if (!claims(ShapeKind::mesh, cube.kind, kPairManifold)) continue;
            const Place at{V(.03, .49, -.02), Q(Eigen::AngleAxisd(turn, V::UnitY()))};
            const auto contacts = meet(box_mesh(.7, .5, .6), kTop, cube, at);
            expect_gap(contacts, -.01);
            EXPECT_GE(contacts.size(), 4u);
            for (const Contact& c : contacts) {
                EXPECT_NEAR(c.gap, -.01, 1e-6);
                EXPECT_NEAR(c.normal.y, -1, 1e-9);
            }
        }
}

TEST_P(Traps, WhatAMeshContainsIsLeftAlone) {
    // Promised: the depth in a mesh is local to triangles that touch, and here none does.
    for (const Shape& inner : {sphere(.1), box(.1, .1, .1), box_hull(.1, .1, .1), cube_mesh(.1, 2)})
        for (double off : {0., .3, .7}) {
            if (!claims(ShapeKind::mesh, inner.kind)) continue;
            SCOPED_TRACE(name_of(inner.kind));
            World world(GetParam());
            world.add(1, cube_mesh(1, 3), {}, Mobility::fixed);
            world.add(2, inner, {V(off, .5 * off, -off), Q::Identity()});
            EXPECT_TRUE(world.detect(.01).empty());
            EXPECT_EQ(world.status().code, Status::ok);
        }
}

TEST_P(Traps, SharedEdgesAndVerticesOfAMeshTouchOnce) {
    // Vertices of the grid stand half a metre apart; one of its edges runs through (.25, 0, .25).
    for (const V& spot : {V(0, 0, 0), V(.25, 0, .25), V(.25, 0, 0)})
        for (double gap : {-.01, 0.}) {
            if (claims(ShapeKind::mesh, ShapeKind::sphere)) {
                const Place at{spot + V(0, .3 + gap, 0), Q::Identity()};
                EXPECT_EQ(meet(grid_mesh(2, 8), {}, sphere(.3), at).size(), 1u);
            }
            if (claims(ShapeKind::mesh, ShapeKind::box)) {
                const Place at{spot + V(0, .5 + gap, 0), Q::Identity()};
                EXPECT_EQ(meet(grid_mesh(2, 8), {}, box(.5, .5, .5), at).size(), 4u);
            }
        }
}

TEST_P(Traps, MeshesOnTwoThreadsAreMeshesOnOne) {
    PLUMB_NEEDS_CLAIM(ShapeKind::sphere, ShapeKind::mesh);
    const Shape torus = torus_mesh(.5, .2, 24, 12), ball = sphere(.3);
    const auto ask = [&](int i) {
        return meet(torus, {}, ball, {V(.5 + .002 * i, .49, .01 * i), Q::Identity()});
    };
    std::vector<std::vector<Contact>> alone;
    for (int i = 0; i < 40; ++i) alone.push_back(ask(i));
    std::atomic<int> different{0};
    const auto work = [&] {
        for (int i = 0; i < 40; ++i) different += !same(ask(i), alone[static_cast<std::size_t>(i)]);
    };
    std::thread other(work);
    work();
    other.join();
    EXPECT_EQ(different, 0);
}

TEST_P(Traps, NoCapCutsAnAnswerShort) {
    PLUMB_NEEDS_CLAIM(ShapeKind::plane, ShapeKind::box, kPairManifold);
    if (!takes(GetParam(), ShapeKind::compound)) GTEST_SKIP() << "no compounds";
    std::vector<std::pair<Shape, Place>> legs;
    for (int i = 0; i < 200; ++i)
        legs.push_back({box(.1, .1, .1), {V(.3 * (i % 20), 0, .3 * (i / 20)), Q::Identity()}});
    EXPECT_EQ(meet(plane(), {}, compound(legs), {V(0, .099, 0), Q::Identity()}).size(), 800u);
}

TEST_P(Traps, DeepBoxesKnowTheirPair) {
    PLUMB_NEEDS_CLAIM(ShapeKind::box, ShapeKind::box);
    const Shape cube = box(.5, .5, .5);
    for (double depth : {.1, .3, .49}) {
        const Q turned(Eigen::AngleAxisd(.3, V::UnitY()));
        expect_gap(meet(cube, kTop, cube, {V(.01, .5 - depth, .02), turned}), -depth);
    }
}

TEST_P(Traps, CoincidingMiddlesArePartedByAShortWay) {
    // The middle of a cone's bounds lies halfway up, as its origin does.
    const Shape shapes[] = {cone(.5, .5), cone(.3, .8), cone(.8, .3), cylinder(.4, .5),
                            box(.5, .4, .3)};
    const Q lying(Eigen::AngleAxisd(M_PI / 2, V::UnitX())),
        over(Eigen::AngleAxisd(M_PI, V::UnitX()));
    Dice dice(5);
    const std::vector<Q> turns = {Q::Identity(),   lying,           over,
                                  kOnEdge,         kOnVertex,       dice.rotation(),
                                  dice.rotation(), dice.rotation(), dice.rotation()};
    for (const Shape& a : shapes)
        for (const Shape& b : shapes)
            for (std::size_t i = 0; i < turns.size(); ++i)
                for (double off : {0., .05}) {
                    if (!claims(a, b)) continue;
                    if (a.kind == ShapeKind::box && b.kind == ShapeKind::box) continue;
                    SCOPED_TRACE(std::string(name_of(a.kind)) + " in " + name_of(b.kind) + " " +
                                 std::to_string(i) + " off " + std::to_string(off));
                    const Place pa{V::Zero(), Q::Identity()}, pb{off * dice.direction(), turns[i]};
                    const auto contacts = meet(a, pa, b, pb);
                    ASSERT_FALSE(contacts.empty());
                    const Contact& c = deepest(contacts);
                    // No direction that the search finds is shorter, and the contact's own proves
                    // it.
                    EXPECT_GT(c.gap, widest_gap(a, pa, b, pb).gap - .005);
                    EXPECT_LT(c.gap, support_gap(a, pa, b, pb, v(c.normal)) + 1e-4);
                }
}

PLUMB_FOR_EACH_PLUGIN(Traps);

}  // namespace
}  // namespace plumb::test
