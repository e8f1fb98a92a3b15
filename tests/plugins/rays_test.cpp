// SPDX-License-Identifier: MIT
/// Rays against every shape: closed forms, points along the ray that are inside or not, and each
/// body alone against all together.
#include "solids.h"

#include <limits>

namespace plumb::test {
namespace {

class Rays : public EachPlugin {
protected:
    void SetUp() override {
        EachPlugin::SetUp();
        if (IsSkipped()) return;
        World world(GetParam());
        if (world.collider().cast_rays(nullptr, nullptr, 0).code == Status::unsupported)
            GTEST_SKIP() << "the plugin casts no rays";
    }
};

constexpr double kInfinity = std::numeric_limits<double>::infinity();

RayRequest ray(const V& origin, const V& direction, double length = 100, std::uint32_t mask = ~0u) {
    return {vec(origin), vec(direction), length, mask, 0};
}

RayHit cast(World& world, const RayRequest& request) {
    RayHit hit{};
    EXPECT_EQ(world.collider().cast_rays(&request, &hit, 1).code, Status::ok);
    return hit;
}

TEST_P(Rays, HitWhatPointsAlongThemSay) {
    Dice dice(11);
    for (const Solid& solid : solids_of(GetParam())) {
        SCOPED_TRACE(solid.name);
        const Place place{V(-1, 2, .5), dice.rotation()};
        World world(GetParam());
        ASSERT_EQ(world.add(4, solid.shape, place).code, Status::ok);
        world.detect(0.01);
        const auto inside = [&](const V& p) {
            return solid.inside(place.q.conjugate() * (p - place.x));
        };
        int hits = 0;
        for (int i = 0; i < 400; ++i) {
            const V to = place.x + dice.within(.5);
            const V d = dice.direction(), from = to - dice.between(0, 2) * d;
            const RayHit hit = cast(world, ray(from, d, 4));
            const bool met = hit.body != kNoBody;
            hits += met;
            EXPECT_TRUE(!met || hit.body == 4u);
            const double end = met ? hit.distance : 4;
            for (int k = 0; k < 60 && end > 0; ++k) {
                const double t = end * (k + .5) / 60;
                EXPECT_FALSE(inside(from + t * d)) << "the ray is inside before it hits";
            }
            if (!met) continue;
            const V n = v(hit.normal);
            EXPECT_NEAR(n.norm(), 1, 1e-9);
            EXPECT_LE(n.dot(d), 0);
            if (inside(from)) {
                EXPECT_EQ(hit.distance, 0);
                EXPECT_LT((n + d).norm(), 1e-12);
                continue;
            }
            const V on = from + hit.distance * d;
            EXPECT_FALSE(inside(on + 1e-6 * n));
            EXPECT_TRUE(n.dot(d) > -1e-3 || inside(on + 1e-6 * d)) << "no surface at the hit";
        }
        EXPECT_GT(hits, 100);
    }
}

TEST_P(Rays, MeetClosedForms) {
    World world(GetParam());
    world.add(0, plane(), {V(0, -2, 0), Q::Identity()}, Mobility::fixed);
    world.add(1, sphere(.5), {});
    world.add(2, box(.5, .4, .3), {V(3, 0, 0), Q::Identity()});
    world.add(3, capsule(.2, .5), {V(6, 0, 0), Q::Identity()});
    world.detect(0.01);
    const double s2 = std::sqrt(.5);
    struct Case {
        V origin, direction;
        std::uint32_t body;
        double distance;
        V normal;
    };
    const Case cases[] = {
        {V(20, 1, 0), -V::UnitY(), 0, 3, V::UnitY()},
        {V(20, 1, 0), V(s2, -s2, 0), 0, 3 / s2, V::UnitY()},
        {V(20, 1, 0), V::UnitY(), kNoBody, 0, V::Zero()},
        {V(20, -2.5, 0), V::UnitX(), 0, 0, -V::UnitX()},
        {V(0, 0, 5), -V::UnitZ(), 1, 4.5, V::UnitZ()},
        {V(.3, 0, 5), -V::UnitZ(), 1, 4.6, V(.6, 0, .8)},
        {V(0, .1, .2), V::UnitX(), 1, 0, -V::UnitX()},
        {V(1.5, .1, .1), V::UnitX(), 2, 1, -V::UnitX()},
        {V(3.1, 3, .1), -V::UnitY(), 2, 2.6, V::UnitY()},
        {V(3, .1, -1e6), V::UnitZ(), 2, 1e6 - .3, -V::UnitZ()},
        {V(6, 5, 0), -V::UnitY(), 3, 4.3, V::UnitY()},
        {V(7, .3, 0), -V::UnitX(), 3, .8, V::UnitX()},
        {V(7, .62, 0), -V::UnitX(), 3, .84, V(.8, .6, 0)},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.origin.transpose());
        const RayHit hit = cast(world, ray(c.origin, c.direction, kInfinity));
        ASSERT_EQ(hit.body, c.body);
        if (c.body == kNoBody) continue;
        EXPECT_NEAR(hit.distance, c.distance, 1e-12 * (1 + c.origin.norm()));
        EXPECT_LT((v(hit.normal) - c.normal).norm(), 1e-9);
    }
}

TEST_P(Rays, ThroughEdgesAndVerticesOfAMeshHitIt) {
    PLUMB_NEEDS_CLAIM(ShapeKind::mesh, ShapeKind::sphere);
    Dice dice(12);
    const Place place{V(.1, .2, .3), dice.rotation()};
    World world(GetParam());
    world.add(0, grid_mesh(1, 8), place, Mobility::fixed);
    world.detect(0.01);
    for (int i = 1; i < 16; ++i)
        for (int j = 1; j < 16; ++j)
            for (double side : {1.0, -1.0}) {
                const V on(-1 + i / 8., 0, -1 + j / 8.), slanted = V(.2, -side, .1).normalized();
                const RayHit hit =
                    cast(world, ray(place.x + place.q * (on - slanted), place.q * slanted));
                ASSERT_EQ(hit.body, 0u);
                EXPECT_NEAR(hit.distance, 1, 1e-12);
                EXPECT_LT((v(hit.normal) - place.q * V(0, side, 0)).norm(), 1e-12)
                    << "a sheet is hit from both sides";
            }
}

TEST_P(Rays, EndWithTheirLengthAndHeedMasks) {
    World world(GetParam());
    world.add(0, sphere(.5), {V(3, 0, 0), Q::Identity()}, Mobility::fixed, 1);
    world.add(1, sphere(.5), {V(5, 0, 0), Q::Identity()}, Mobility::dynamic, 2);
    world.detect(0.01);
    const V x = V::UnitX();
    EXPECT_EQ(cast(world, ray(V::Zero(), x, 2.49)).body, kNoBody);
    EXPECT_EQ(cast(world, ray(V::Zero(), x, 2.51)).body, 0u);
    EXPECT_EQ(cast(world, ray(V::Zero(), x, 9, 2)).body, 1u);
    EXPECT_EQ(cast(world, ray(V::Zero(), x, 9, 4)).body, kNoBody);
    world.move(0, {V(0, 3, 0), Q::Identity()});
    world.detect(0.01);
    EXPECT_EQ(cast(world, ray(V::Zero(), x)).body, 1u);
    EXPECT_EQ(cast(world, ray(V::Zero(), V::UnitY())).body, 0u);
    world.collider().remove(1);
    EXPECT_EQ(cast(world, ray(V::Zero(), x)).body, kNoBody);
}

TEST_P(Rays, NameThePartOfACompound) {
    World world(GetParam());
    world.add(2,
              compound({{box(.2, .2, .2), {V(-1, 0, 0), Q::Identity()}},
                        {sphere(.2), {V(1, 0, 0), Q::Identity()}}}),
              {V(0, 1, 0), Q::Identity()});
    world.detect(0.01);
    const RayHit box_hit = cast(world, ray(V(-5, 1, 0), V::UnitX()));
    EXPECT_EQ(box_hit.part, 0u);
    EXPECT_NEAR(box_hit.distance, 3.8, 1e-12);
    const RayHit ball_hit = cast(world, ray(V(5, 1, 0), -V::UnitX()));
    EXPECT_EQ(ball_hit.part, 1u);
    EXPECT_NEAR(ball_hit.distance, 3.8, 1e-12);
}

TEST_P(Rays, InACrowdHitTheNearestOfAll) {
    Dice dice(13);
    const std::vector<Solid> solids = solids_of(GetParam());
    std::vector<RayRequest> rays;
    for (int i = 0; i < 300; ++i)
        rays.push_back(ray(dice.within(4), dice.direction(), i % 3 ? kInfinity : 2));
    std::vector<RayHit> best(rays.size(), RayHit{kNoBody, 0, kInfinity, {}}), hits(rays.size());
    World all(GetParam());
    all.add(0, plane(), {V(0, -3, 0), Q::Identity()}, Mobility::fixed);
    World ground(GetParam());
    ground.add(0, plane(), {V(0, -3, 0), Q::Identity()}, Mobility::fixed);
    const auto take = [&](World& one) {
        one.detect(0.01);
        ASSERT_EQ(one.collider().cast_rays(rays.data(), hits.data(), 300).code, Status::ok);
        for (std::size_t i = 0; i < hits.size(); ++i)
            if (hits[i].body != kNoBody && hits[i].distance < best[i].distance) best[i] = hits[i];
    };
    take(ground);
    for (std::uint32_t i = 1; i <= 80; ++i) {
        const Place place{dice.within(3), dice.rotation()};
        const Shape& shape = solids[i % solids.size()].shape;
        all.add(i, shape, place);
        World one(GetParam());
        one.add(i, shape, place);
        take(one);
    }
    all.detect(0.01);
    ASSERT_EQ(all.collider().cast_rays(rays.data(), hits.data(), 300).code, Status::ok);
    int met = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        ASSERT_EQ(hits[i].body, best[i].body) << i;
        if (best[i].body == kNoBody) continue;
        ++met;
        EXPECT_EQ(hits[i].distance, best[i].distance);
        EXPECT_EQ(hits[i].part, best[i].part);
        EXPECT_EQ(v(hits[i].normal), v(best[i].normal));
    }
    EXPECT_GT(met, 100);
}

TEST_P(Rays, WithBadNumbersHitNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    World world(GetParam());
    world.add(0, plane(), {}, Mobility::fixed);
    world.detect(0.01);
    const V down = -V::UnitY();
    const RayRequest rays[] = {ray(V(0, 1, 0), down),      ray(V(nan, 1, 0), down),
                               ray(V(0, 1, 0), V::Zero()), ray(V(0, 1, 0), V(0, nan, 0)),
                               ray(V(0, 1, 0), 2 * down),  ray(V(0, 1, 0), down, -1),
                               ray(V(0, 1, 0), down, nan), ray(V(0, kInfinity, 0), down)};
    RayHit hits[8];
    const Status status = world.collider().cast_rays(rays, hits, 8);
    EXPECT_EQ(status.code, Status::bad_argument);
    EXPECT_EQ(status.count, 7u);
    EXPECT_TRUE(status.message);
    EXPECT_EQ(hits[0].body, 0u);
    for (int i = 1; i < 8; ++i) EXPECT_EQ(hits[i].body, kNoBody) << i;
    EXPECT_EQ(world.collider().cast_rays(nullptr, nullptr, 0).code, Status::ok);
    EXPECT_EQ(world.collider().cast_rays(nullptr, nullptr, 1).code, Status::bad_argument);
}

PLUMB_FOR_EACH_PLUGIN(Rays);

}  // namespace
}  // namespace plumb::test
