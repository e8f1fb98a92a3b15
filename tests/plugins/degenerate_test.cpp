// SPDX-License-Identifier: MIT
/// Shapes at the edge of what numbers bear: tiny, huge, needles, hulls with faces in one plane or
/// vertices twice.
#include "standing.h"

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
