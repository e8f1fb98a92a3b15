// SPDX-License-Identifier: MIT
/// Pairs whose answer is known in closed form, at several gaps, turned as a whole, and with the ids
/// swapped.
///
/// Each case stands one shape on another along +y: at gap 0 the upper one touches. A plugin meets
/// every case whose pair it claims; which pairs it must claim at least is a test of its own.
#include "harness.h"

#include "math/rotation_between.h"

namespace plumb::test {
namespace {

class ClosedForm : public EachPlugin {};

struct Case {
    const char* name;
    Shape lower, upper;
    Place lower_place, upper_place;  ///< touching, upper above lower along +y
    std::size_t points;              ///< at least so many in a full manifold
};

std::vector<Case> cases() {
    const V x = V::UnitX(), y = V::UnitY(), z = V::UnitZ();
    const Q flat = Q::Identity(), lying = turn(90, z), edge = turn(45, x), tilted = turn(30, y);
    const Q on_vertex = rotation_between(V(1, 1, 1).normalized(), -y),
            under_vertex = rotation_between(V(1, 1, 1).normalized(), y);
    const double s2 = std::sqrt(0.5), s3 = std::sqrt(0.75);
    const Shape cube = box(.5, .5, .5), slab = box(2, .5, 2), ball = sphere(.5),
                pill = capsule(.2, .5);
    const Shape can = cylinder(.5, .5), cubic = box_hull(.5, .5, .5), hat = cone(.5, .5);
    const Place ground{}, top{V(0, -.5, 0), flat};
    const auto at = [](double h, const Q& q) { return Place{V(.1, h, .05), q}; };
    const auto over = [](double h, const Q& q) { return Place{V(0, h, 0), q}; };
    return {
        {"sphere on plane", plane(), ball, ground, at(.5, flat), 1},
        {"box on plane", plane(), cube, ground, at(.5, tilted), 4},
        {"box on its edge on plane", plane(), cube, ground, at(s2, edge), 2},
        {"box on its vertex on plane", plane(), cube, ground, at(s3, on_vertex), 1},
        {"capsule lying on plane", plane(), pill, ground, at(.2, lying), 2},
        {"capsule upright on plane", plane(), pill, ground, at(.7, flat), 1},
        {"sphere on sphere", ball, ball, top, over(.5, flat), 1},
        {"sphere on box", slab, ball, top, at(.5, tilted), 1},
        {"sphere on box edge", cube, ball, {V(0, -s2, 0), edge}, over(.5, flat), 1},
        {"sphere on capsule", pill, ball, {V(0, -.2, 0), lying}, over(.5, flat), 1},
        {"capsule across capsule",
         pill,
         pill,
         {V(0, -.2, 0), lying},
         {V(.1, .2, .1), turn(90, x)},
         1},
        {"capsule along capsule", pill, pill, {V(0, -.2, 0), lying}, {V(.1, .2, 0), lying}, 2},
        {"capsule lying on box", slab, pill, top, at(.2, lying), 2},
        {"capsule across a box edge", cube, pill, {V(0, -s2, 0), edge}, over(.2, turn(90, x)), 1},
        {"capsule along a box edge", cube, pill, {V(0, -s2, 0), edge}, over(.2, lying), 2},
        {"capsule over a box vertex", cube, pill, {V(0, -s3, 0), under_vertex}, over(.7, flat), 1},
        {"box on box", slab, cube, top, at(.5, tilted), 4},
        {"box on equal box", cube, cube, top, over(.5, flat), 4},
        {"box on its edge on box", slab, cube, top, at(s2, edge), 2},
        {"box on its vertex on box", slab, cube, top, at(s3, on_vertex), 1},
        {"box edge across box edge", cube, cube, {V(0, -s2, 0), turn(45, z)}, over(s2, edge), 1},
        {"cylinder upright on plane", plane(), can, ground, at(.5, flat), 4},
        {"cylinder lying on plane", plane(), can, ground, at(.5, lying), 2},
        {"cylinder upright on box", slab, can, top, at(.5, flat), 4},
        {"cylinder lying on box", slab, can, top, at(.5, lying), 2},
        {"cylinder on cylinder", can, can, top, over(.5, flat), 4},
        {"sphere on cylinder", can, ball, top, at(.5, flat), 1},
        {"sphere on lying cylinder", can, ball, {V(0, -.5, 0), lying}, over(.5, flat), 1},
        {"capsule lying on cylinder", can, capsule(.1, .2), top, over(.1, lying), 2},
        {"hull on plane", plane(), cubic, ground, at(.5, tilted), 4},
        {"sphere on hull", cubic, ball, top, at(.5, flat), 1},
        {"capsule lying on hull", cubic, capsule(.1, .2), top, over(.1, lying), 2},
        {"hull on box", slab, cubic, top, at(.5, tilted), 4},
        {"hull on hull", cubic, cubic, top, over(.5, tilted), 8},
        {"octahedron tip on hull", cubic, octahedron(.5), top, at(.5, flat), 1},
        {"hull edge across hull edge",
         cubic,
         cubic,
         {V(0, -s2, 0), turn(45, z)},
         over(s2, edge),
         1},
        {"hull on cylinder", can, cubic, top, over(.5, tilted), 4},
        {"cone on plane", plane(), hat, ground, at(.5, flat), 4},
        {"cone on box", slab, hat, top, at(.5, flat), 4},
        {"sphere on mesh", grid_mesh(2, 4), ball, ground, at(.5, flat), 1},
        {"box on mesh", grid_mesh(2, 4), cube, ground, at(.5, tilted), 4},
        {"capsule lying on mesh", grid_mesh(2, 4), pill, ground, at(.2, lying), 2},
        {"torus on plane", plane(), torus_mesh(.5, .2, 48, 24), ground, at(.2, flat), 4},
    };
}

std::uint32_t wanted_ability(const Case& c, double gap) {
    return gap > 0 ? kPairSeparated : c.points > 1 ? kPairManifold : kPairPoint;
}

/// One case at one gap, moved as a whole by `frame`, with the lower body first or second.
void check(const std::string& name, const Case& c, double gap, const Place& frame,
           bool lower_first) {
    World world(name);
    const std::uint32_t lower = lower_first ? 1 : 2, upper = 3 - lower;
    Place raised = c.upper_place;
    raised.x.y() += gap;
    ASSERT_EQ(world.add(lower, c.lower, frame * c.lower_place, Mobility::fixed).code, Status::ok);
    ASSERT_EQ(world.add(upper, c.upper, frame * raised).code, Status::ok);
    const double margin = 0.01;
    const auto& contacts = world.detect(margin);
    ASSERT_FALSE(contacts.empty());
    expect_sound(contacts, margin);

    const Contact& d = deepest(contacts);
    EXPECT_NEAR(d.gap, gap, 2e-5);
    const V up = frame.q * V::UnitY() * (lower_first ? -1.0 : 1.0);
    EXPECT_GT(v(d.normal).dot(up), std::cos(0.5 * M_PI / 180));
    EXPECT_GE(contacts.size(), c.points);
}

TEST_P(ClosedForm, MeetsClosedForms) {
    const Place home{}, away{V(3, -2, 5), turn(77, V(1, 2, -3))};
    for (const Case& c : cases())
        for (double gap : {0.005, 0.0, -0.0005, -0.005}) {
            if (!(ability(GetParam(), c.lower.kind, c.upper.kind) & wanted_ability(c, gap)))
                continue;
            for (const Place& frame : {home, away})
                for (bool lower_first : {true, false}) {
                    SCOPED_TRACE(std::string(c.name) + " at gap " + std::to_string(gap) +
                                 (frame.x.norm() > 0 ? " turned" : "") +
                                 (lower_first ? "" : " swapped"));
                    check(GetParam(), c, gap, frame, lower_first);
                }
        }
}

/// What lies across a flat round end touches it over the chord of the circle, whichever way it
/// points.
TEST_P(ClosedForm, EndsWhatLiesAcrossARimOnTheCircle) {
    const double radius = .3, off = .11, chord = std::sqrt(radius * radius - off * off);
    for (const Shape& rod : {capsule(.1, 1), cylinder(.1, 1)})
        for (const Shape& disc : {cylinder(radius, .2), cone(radius, .2)})
            for (double angle : {0., 10., 22.5, 50.}) {
                if (!claims(rod, disc, kPairManifold)) continue;
                const bool upside_down = disc.kind == ShapeKind::cone;  // its flat end up
                const Q up = upside_down ? turn(180, V::UnitX()) : Q::Identity();
                const V way = turn(angle, V::UnitY()) * V::UnitX();
                World world(GetParam());
                world.add(0, disc, {V(0, -.2, 0), up});
                world.add(1, rod,
                          {V(0, .0999, 0) + off * V::UnitY().cross(way),
                           rotation_between(V::UnitY(), way)});
                SCOPED_TRACE(std::string(name_of(rod.kind)) + " on " + name_of(disc.kind) + " " +
                             std::to_string(angle));
                double low = 0, high = 0;
                for (const Contact& c : world.detect(0.01)) {
                    low = std::min(low, v(c.point_a).dot(way));
                    high = std::max(high, v(c.point_a).dot(way));
                }
                EXPECT_NEAR(low, -chord, 1e-5);
                EXPECT_NEAR(high, chord, 1e-5);
            }
}

TEST_P(ClosedForm, LaysATorusMeshOnAFlatMesh) {
    const std::uint32_t able = ability(GetParam(), ShapeKind::mesh, ShapeKind::mesh);
    World world(GetParam());
    const Status lower = world.add(1, grid_mesh(2, 4), {}, Mobility::fixed);
    const Status upper =
        world.add(2, torus_mesh(.5, .2, 48, 24), {V(.1, .195, .05), Q::Identity()});
    EXPECT_EQ(lower.code, able ? Status::ok : Status::unsupported);
    EXPECT_EQ(upper.code, able ? Status::ok : Status::unsupported);
    const auto& contacts = world.detect(0.01);
    EXPECT_EQ(contacts.empty(), able == 0);
    if (contacts.empty()) return;
    expect_sound(contacts, 0.01);
    EXPECT_GE(contacts.size(), 4u);
    EXPECT_LE(contacts.size(), 16u);
    EXPECT_NEAR(deepest(contacts).gap, -.005, 2e-5);
    for (const Contact& c : contacts) EXPECT_NEAR(c.normal.y, -1, 1e-6);
    EXPECT_GT(spanned_area(contacts), .5) << "the ring of radius 0.5 spans 0.78";
}

TEST_P(ClosedForm, ReportsNothingBeyondTheMargin) {
    for (const Case& c : cases()) {
        if (!ability(GetParam(), c.lower.kind, c.upper.kind)) continue;
        SCOPED_TRACE(c.name);
        World world(GetParam());
        Place raised = c.upper_place;
        raised.x.y() += 0.0101;
        world.add(1, c.lower, c.lower_place, Mobility::fixed);
        world.add(2, c.upper, raised);
        EXPECT_TRUE(world.detect(0.01).empty());
    }
}

TEST_P(ClosedForm, SweepsWidenTheMargin) {
    PLUMB_NEEDS_CLAIM(ShapeKind::plane, ShapeKind::sphere, kPairSeparated);
    World world(GetParam());
    world.add(0, plane(), {}, Mobility::fixed);
    world.add(1, sphere(.5), {V(0, .6, 0), Q::Identity()});
    EXPECT_TRUE(world.detect(0.01).empty());
    world.sweeps = {0, 0.095};
    ASSERT_EQ(world.detect(0.01).size(), 1u);
    EXPECT_NEAR(world.last()[0].gap, 0.1, 1e-9);
}

PLUMB_FOR_EACH_PLUGIN(ClosedForm);

}  // namespace
}  // namespace plumb::test
