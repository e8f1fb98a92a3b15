// SPDX-License-Identifier: MIT
/// Convex shapes on meshes and height fields, where the answer is known: on flat grids, over a
/// convex edge, in a hollow one, on a tessellated sphere, below the surface, at a border.
#include "surfaces.h"

#include <set>

namespace plumb::test {
namespace {

class Surfaces : public EachPlugin {
protected:
    bool can(ShapeKind a, ShapeKind b) const {
        return (ability(GetParam(), a, b) & kPairSeparated) != 0;
    }
};

Q turn(double degrees, const V& axis) {
    return Q(Eigen::AngleAxisd(degrees * M_PI / 180, axis.normalized()));
}

struct Body {
    const char* name;
    Shape shape;
    Q q;
    double low;           ///< the origin's height over its lowest point [m]
    std::size_t points;   ///< of a full manifold on a plane
    double exact = 1e-9;  ///< [m]; clipping may run past the edge of a tilted face by 1e-7 of it
};

std::vector<Body> bodies() {
    const Q lying = turn(90, V::UnitZ()), spun = turn(30, V::UnitY());
    return {
        {"sphere", sphere(.3), Q::Identity(), .3, 1},
        {"box", box(.3, .2, .25), spun, .2, 4},
        {"box on its edge", box(.3, .3, .3), spun * turn(45, V::UnitX()), std::sqrt(.18), 2, 1e-6},
        {"capsule", capsule(.15, .3), spun * lying, .15, 2},
        {"upright cylinder", cylinder(.3, .2), Q::Identity(), .2, 4},
        {"lying cylinder", cylinder(.2, .3), spun * lying, .2, 2},
        {"hull", box_hull(.3, .2, .25), spun, .2, 4},
        {"cone", cone(.3, .2), Q::Identity(), .2, 4}};
}

/// Bodies at a fixed spot of a surface, with the surface's id below and above theirs.
const std::vector<Contact>& meet(World& world, const Shape& surface, const Shape& shape,
                                 const Place& place, double margin, bool surface_first = true) {
    EXPECT_EQ(world.add(surface_first ? 0 : 2, surface, {}, Mobility::fixed).code, Status::ok);
    EXPECT_EQ(world.add(1, shape, place).code, Status::ok);
    world.move(2, {});
    return world.detect(margin);
}

/// Normal out of the surface.
V outward(const Contact& c, bool surface_first = true) {
    return surface_first ? V(-v(c.normal)) : v(c.normal);
}

TEST_P(Surfaces, LieOnFlatTrianglesAsOnAPlane) {
    for (const Shape& surface :
         {quad_mesh(2), grid_mesh(2, 16), height_field(2, 8, [](double, double) { return 0; })})
        for (const Body& b : bodies())
            for (double gap : {.005, 0., -.0005, -.005})
                for (bool first : {true, false}) {
                    if (!can(surface.kind, b.shape.kind)) continue;
                    SCOPED_TRACE(std::string(b.name) + " at gap " + std::to_string(gap));
                    World world(GetParam()), flat(GetParam());
                    const Place at{V(.11, b.low + gap, .07), b.q};
                    const auto& contacts = meet(world, surface, b.shape, at, .01, first);
                    const auto& ideal = meet(flat, plane(), b.shape, at, .01, first);
                    expect_sound(contacts, .01);
                    ASSERT_GE(contacts.size(), b.points);
                    EXPECT_LE(contacts.size(), 10u);
                    EXPECT_GE(spanned_area(contacts), spanned_area(ideal) - 1e-6);
                    for (const Contact& c : contacts) {
                        EXPECT_NEAR(outward(c, first).y(), 1, 1e-12);
                        EXPECT_NEAR(c.gap, gap, b.exact);
                    }
                    if (b.points == 4 && ideal.size() == 4) {
                        EXPECT_EQ(contacts.size(), 4u);
                    }
                }
}

TEST_P(Surfaces, SlideOverInnerEdgesWithoutABump) {
    for (const Shape& surface :
         {grid_mesh(2, 16), height_field(2, 16, [](double, double) { return 0; })})
        for (const Body& b : bodies()) {
            if (!can(surface.kind, b.shape.kind)) continue;
            World world(GetParam());
            world.add(0, surface, {}, Mobility::fixed);
            world.add(1, b.shape, {});
            const Q leaning = turn(.7, V(1, .2, .4)) * b.q;
            for (const Q& q : {b.q, leaning})
                for (double depth : {-.004, .001, .01, .03})
                    for (int i = 0; i < 40; ++i) {
                        SCOPED_TRACE(std::string(b.name) + " step " + std::to_string(i) +
                                     " depth " + std::to_string(depth));
                        world.move(1, {V(-.6 + .031 * i, b.low - depth, .3 - .017 * i), q});
                        const auto& contacts = world.detect(.01);
                        ASSERT_FALSE(contacts.empty());
                        for (const Contact& c : contacts)
                            ASSERT_LT((outward(c) - V::UnitY()).norm(), 1e-6);
                    }
        }
}

TEST_P(Surfaces, TakeTheNormalOfAConvexEdge) {
    // A sphere over a ridge: its normal points from the ridge to its centre, at any angle between
    // the two faces' normals, and is the face's beyond.
    const double slope = .4, r = .3;
    if (!can(ShapeKind::mesh, ShapeKind::sphere)) return;
    for (double angle = -.6; angle <= .61; angle += .1)
        for (double gap : {.004, -.004}) {
            World world(GetParam());
            const double cone_angle = std::clamp(angle, -slope, slope);
            const V n(std::sin(cone_angle), std::cos(cone_angle), 0);
            const V along = angle == cone_angle ? V::Zero()
                            : angle > 0         ? V(std::cos(slope), -std::sin(slope), 0)
                                                : V(-std::cos(slope), -std::sin(slope), 0);
            const V centre = (r + gap) * n + .1 * along + V(0, 0, .07);
            const auto& contacts =
                meet(world, roof_mesh(slope, 2), sphere(r), {centre, Q::Identity()}, .01);
            SCOPED_TRACE(angle);
            ASSERT_FALSE(contacts.empty());
            const Contact& c = deepest(contacts);
            EXPECT_NEAR(c.gap, gap, 1e-9);
            EXPECT_LT((outward(c) - n).norm(), 1e-6);
        }
}

TEST_P(Surfaces, LayABoxAcrossAConvexEdge) {
    for (double gap : {.004, -.004}) {
        if (!can(ShapeKind::mesh, ShapeKind::box)) return;
        World world(GetParam());
        const auto& contacts = meet(world, roof_mesh(.4, 2), box(.3, .2, .25),
                                    {V(.05, .2 + gap, 0), Q::Identity()}, .01);
        expect_sound(contacts, .01);
        ASSERT_GE(contacts.size(), 2u);
        double low = 1, high = -1;
        for (const Contact& c : contacts) {
            EXPECT_LT((outward(c) - V::UnitY()).norm(), 1e-6);
            low = std::min(low, c.point_a.z), high = std::max(high, c.point_a.z);
        }
        EXPECT_NEAR(deepest(contacts).gap, gap, 1e-9);
        EXPECT_NEAR(low, -.25, 1e-6) << "the ridge carries the box over its whole length";
        EXPECT_NEAR(high, .25, 1e-6);
    }
}

TEST_P(Surfaces, KeepBothNormalsOfAHollow) {
    const double slope = .5, r = .3;
    for (const Shape& shape : {sphere(r), capsule(r, .2)})
        for (double gap : {.003, -.003}) {
            if (!can(ShapeKind::mesh, shape.kind)) continue;
            World world(GetParam());
            const Q along_z = turn(90, V::UnitX());
            const auto& contacts = meet(world, roof_mesh(-slope, 2), shape,
                                        {V(0, (r + gap) / std::cos(slope), .1), along_z}, .01);
            expect_sound(contacts, .01);
            bool left = false, right = false;
            for (const Contact& c : contacts) {
                EXPECT_NEAR(c.gap, gap, 1e-9);
                EXPECT_NEAR(std::abs(outward(c).x()), std::sin(slope), 1e-6);
                (outward(c).x() > 0 ? left : right) = true;
            }
            EXPECT_TRUE(left && right);
        }
}

TEST_P(Surfaces, MeasureATessellatedSphereWithinItsSagitta) {
    const double r = .5, small = .2;
    const int rings = 24;
    const double sagitta = 2 * r * (1 - std::cos(M_PI / rings));
    if (!can(ShapeKind::mesh, ShapeKind::sphere)) return;
    for (int i = 0; i < 60; ++i) {
        const V n = (turn(137.5 * i, V::UnitY()) * turn(3 * i, V::UnitX()) * V::UnitY());
        World world(GetParam());
        const auto& contacts = meet(world, sphere_mesh(r, rings), sphere(small),
                                    {(r + small - .01) * n, Q::Identity()}, .01);
        ASSERT_FALSE(contacts.empty()) << i;
        const Contact& c = deepest(contacts);
        EXPECT_GE(c.gap, -.01 - 1e-9);
        EXPECT_LE(c.gap, -.01 + sagitta);
        EXPECT_GT(outward(c).dot(n), std::cos(M_PI / rings));
    }
}

TEST_P(Surfaces, PushOutWhatLiesBelow) {
    // Up to its least width below a mesh, and at any depth below a height field.
    const Shape field = height_field(2, 8, [](double, double) { return 0; });
    for (const Shape& surface : {grid_mesh(2, 8), field})
        for (const Body& b : bodies()) {
            if (!can(surface.kind, b.shape.kind)) continue;
            std::vector<double> depths = {.1, .25};
            if (surface.kind == ShapeKind::height_field) depths.push_back(7);
            for (double depth : depths) {
                SCOPED_TRACE(std::string(b.name) + " depth " + std::to_string(depth));
                World world(GetParam());
                const auto& contacts =
                    meet(world, surface, b.shape, {V(.11, b.low - depth, .07), b.q}, .01);
                expect_sound(contacts, .01);
                ASSERT_FALSE(contacts.empty());
                EXPECT_NEAR(deepest(contacts).gap, -depth, 1e-6);
                for (const Contact& c : contacts) EXPECT_LT((outward(c) - V::UnitY()).norm(), 1e-6);
            }
        }
}

TEST_P(Surfaces, DoNotCatchABoxOnTheSideOfABlock) {
    // The rows of triangles down the side of a block lie inside a box that overhangs its top.
    if (!can(ShapeKind::mesh, ShapeKind::box)) return;
    const Shape block = cube_mesh(.5, 20);
    for (double depth : {.001, .005})
        for (double lean : {-1., 0., 1.}) {
            World world(GetParam());
            const Q q = turn(lean, V::UnitZ());
            const auto& contacts =
                meet(world, block, box(.3, .3, .3), {V(.52, .8 - depth, .03), q}, .01);
            ASSERT_FALSE(contacts.empty());
            for (const Contact& c : contacts) EXPECT_GT(outward(c).y(), .99);
        }
}

TEST_P(Surfaces, AreLeftAtABorder) {
    if (!can(ShapeKind::mesh, ShapeKind::sphere)) return;
    World beside(GetParam()), over(GetParam()), below(GetParam());
    const double r = .3;
    // Beside the border, a little above: the normal points from the border to the centre.
    const V n = V(1, 1, 0).normalized();
    const auto& contacts =
        meet(beside, quad_mesh(1), sphere(r), {V(1, 0, .2) + (r - .01) * n, Q::Identity()}, .01);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_LT((outward(contacts[0]) - n).norm(), 1e-6);
    EXPECT_NEAR(contacts[0].gap, -.01, 1e-9);
    EXPECT_TRUE(meet(over, quad_mesh(1), sphere(r), {V(1.5, .1, 0), Q::Identity()}, .01).empty());
    EXPECT_TRUE(
        meet(below, quad_mesh(1), sphere(r), {V(0, -2 * r - .001, 0), Q::Identity()}, .01).empty());
}

double bumps(double x, double z) { return .15 * std::sin(3 * x) * std::cos(2.3 * z); }

TEST_P(Surfaces, AreTheSameAsAHeightFieldAndAsAMesh) {
    const Shape field = height_field(1.5, 15, bumps), same = mesh_of(field);
    for (const Body& b : bodies()) {
        if (!can(ShapeKind::height_field, b.shape.kind)) continue;
        if (!can(ShapeKind::mesh, b.shape.kind)) continue;
        std::size_t found = 0;
        for (int i = 0; i < 40; ++i) {
            const V spot(-1 + .05 * i, 0, .6 - .03 * i);
            const Place at{spot + V(0, bumps(spot.x(), spot.z()) + b.low - .01, 0),
                           turn(11 * i, V::UnitY()) * b.q};
            World p(GetParam()), q(GetParam());
            const auto& own = meet(p, field, b.shape, at, .01);
            const auto& other = meet(q, same, b.shape, at, .01);
            found += own.size();
            ASSERT_EQ(own.size(), other.size()) << b.name << i;
            for (std::size_t k = 0; k < own.size(); ++k) {
                EXPECT_EQ(own[k].feature, other[k].feature);
                EXPECT_EQ(own[k].part_a, other[k].part_a);
                EXPECT_NEAR(own[k].gap, other[k].gap, 1e-9);
                EXPECT_LT((v(own[k].normal) - v(other[k].normal)).norm(), 1e-9);
                EXPECT_LT((v(own[k].point_b) - v(other[k].point_b)).norm(), 1e-9);
            }
        }
        EXPECT_GT(found, 30u);
    }
}

TEST_P(Surfaces, NameTheSameFeaturesWhileSlidingInsideATriangle) {
    for (const Body& b : bodies()) {
        if (!can(ShapeKind::mesh, b.shape.kind)) continue;
        std::set<std::uint64_t> before;
        World world(GetParam());
        world.add(0, quad_mesh(4), {}, Mobility::fixed);
        world.add(1, b.shape, {});
        for (int i = 0; i < 20; ++i) {
            world.move(1, {V(-2 + .01 * i, b.low - .001, 2 + .013 * i), b.q});
            std::set<std::uint64_t> now;
            for (const Contact& c : world.detect(.01)) now.insert(c.feature);
            EXPECT_GE(now.size(), b.points);
            if (i > 0) {
                EXPECT_EQ(now, before) << b.name << " step " << i;
            }
            before = now;
        }
    }
}

TEST_P(Surfaces, RefuseAHeightFieldThatCannotBe) {
    if (!takes(GetParam(), ShapeKind::height_field)) GTEST_SKIP() << "no height fields";
    World world(GetParam());
    Shape field = height_field(.5, 2, [](double, double) { return 0; });
    field.spacing_x = 0;
    EXPECT_EQ(world.add(0, field, {}, Mobility::fixed).code, Status::bad_argument);
    field.spacing_x = std::nan("");
    EXPECT_EQ(world.add(0, field, {}, Mobility::fixed).code, Status::bad_argument);
    const Shape hole = height_field(.5, 2, [](double x, double) { return 1 / std::abs(x); });
    EXPECT_EQ(world.add(0, hole, {}, Mobility::fixed).code, Status::bad_argument);
    field = height_field(.5, 2, [](double, double) { return 0; });
    field.rows = 1;
    EXPECT_EQ(world.add(0, field, {}, Mobility::fixed).code, Status::bad_argument);
}

PLUMB_FOR_EACH_PLUGIN(Surfaces);

}  // namespace
}  // namespace plumb::test
