// SPDX-License-Identifier: MIT
/// Shapes at the edge of what numbers bear: tiny, huge, needles, hulls with faces in one plane or
/// vertices twice.
#include "dice.h"
#include "standing.h"

#include <array>

namespace plumb::test {
namespace {

class Degenerate : public EachPlugin {
protected:
    /// A hull with the place of a cube of half side 0.5: `doubled` names each corner twice.
    static Shape triangulated_cube(bool doubled) {
        std::vector<V> corners;
        for (int i = 0; i < (doubled ? 16 : 8); ++i)
            corners.push_back(0.5 * V(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
        return hull(corners, {{0, 2, 3},
                              {0, 3, 1},
                              {4, 5, 7},
                              {4, 7, 6},
                              {0, 1, 5},
                              {0, 5, 4},
                              {2, 6, 7},
                              {2, 7, 3},
                              {0, 4, 6},
                              {0, 6, 2},
                              {1, 3, 7},
                              {1, 7, 5}});
    }
};

TEST_P(Degenerate, TinyAndHugeShapesTouchAlike) {
    for (double size : {1e-3, 1e3})
        for (const Stack& stack : stacks(GetParam(), size)) {
            SCOPED_TRACE(stack.name() + " of size " + std::to_string(size));
            World world(GetParam());
            build(world, stack, -0.01 * size);
            const auto& contacts = world.detect(0.02 * size);
            ASSERT_FALSE(contacts.empty());
            EXPECT_NEAR(deepest(contacts).gap, -0.01 * size,
                        3 * size * relative_accuracy(GetParam()));
            EXPECT_LT(deepest(contacts).normal.y, -0.9999);
        }
}

/// Cylinders of one radius on one axis, turned about it: wherever their rims meet, they meet all
/// around.
TEST_P(Degenerate, CylindersStandOnCylindersOfTheSameAxis) {
    PLUMB_NEEDS_CLAIM(ShapeKind::cylinder, ShapeKind::cylinder, kPairManifold);
    Dice dice(23);
    World world(GetParam());
    for (int i = 0; i < 600; ++i) {
        const double radius = dice.between(0.02, 0.5), half = radius * dice.between(0.2, 3);
        const double gap = std::array{-1e-3, -1e-7, 0.0, 1e-4}[i % 4] * radius;
        const auto turned = [&] { return Q(Eigen::AngleAxisd(dice.between(-3, 3), V::UnitY())); };
        const Q lean = i % 3 == 0 ? dice.rotation() : Q::Identity();
        const Place a{V(0, half, 0), lean * turned()};
        const Place b{a.x + lean * V(0, 2 * half + gap, 0), lean * turned()};
        ASSERT_EQ(world.add(1, cylinder(radius, half), a).code, Status::ok);
        ASSERT_EQ(world.add(2, cylinder(radius, half), b).code, Status::ok);
        const auto& contacts = world.detect(0.01 * radius);
        ASSERT_EQ(world.status().code, Status::ok)
            << "pair " << i << ": " << world.status().message;
        ASSERT_GE(contacts.size(), 3u) << "pair " << i;
        EXPECT_NEAR(deepest(contacts).gap, gap, radius * relative_accuracy(GetParam()));
        EXPECT_LT(v(contacts[0].normal).dot(lean * V::UnitY()), -0.9999) << "pair " << i;
        world.collider().remove(1);
        world.collider().remove(2);
    }
}

TEST_P(Degenerate, NeedlesLieWhereTheyLie) {
    for (const Shape& needle : {box(.5, 5e-5, 5e-5), box_hull(.5, 5e-5, 5e-5)})
        for (const Shape& floor : {plane(), box(1, .5, 1)}) {
            if (!claims(floor, needle, kPairManifold)) continue;
            SCOPED_TRACE(std::string(name_of(needle.kind)) + " on " + name_of(floor.kind));
            World world(GetParam());
            const bool flat = floor.kind == ShapeKind::plane;
            world.add(1, floor, flat ? Place{} : Place{V(0, -.5, 0), Q::Identity()},
                      Mobility::fixed);
            world.add(2, needle, {V(.1, 4e-5, .05), Q::Identity()});
            const auto& contacts = world.detect(0.01);
            ASSERT_GE(contacts.size(), 2u);
            EXPECT_NEAR(deepest(contacts).gap, -1e-5, relative_accuracy(GetParam()));
            EXPECT_LT(contacts[0].normal.y, -0.9999);
        }
}

TEST_P(Degenerate, FacesInOnePlaneAreOneFace) {
    PLUMB_NEEDS_CLAIM(ShapeKind::hull, ShapeKind::hull, kPairManifold);
    for (bool doubled : {false, true})
        for (const Shape& floor : {plane(), box(2, .5, 2), box_hull(2, .5, 2)}) {
            if (!claims(floor.kind, ShapeKind::hull, kPairManifold)) continue;
            SCOPED_TRACE(std::string(doubled ? "vertices twice" : "triangles") + " on " +
                         name_of(floor.kind));
            World world(GetParam());
            const bool flat = floor.kind == ShapeKind::plane;
            world.add(1, floor, flat ? Place{} : Place{V(0, -.5, 0), Q::Identity()},
                      Mobility::fixed);
            world.add(2, triangulated_cube(doubled), {V(.1, .498, .05), Q::Identity()});
            const auto& contacts = world.detect(0.01);
            ASSERT_GE(contacts.size(), 4u);
            expect_sound(contacts, 0.01);
            EXPECT_NEAR(deepest(contacts).gap, -.002, relative_accuracy(GetParam()));
            EXPECT_GE(spanned_area(contacts), 0.99);
        }
}

PLUMB_FOR_EACH_PLUGIN(Degenerate);

}  // namespace
}  // namespace plumb::test
