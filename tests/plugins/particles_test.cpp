// SPDX-License-Identifier: MIT
/// Particles against every shape: inside and outside, against closed forms, against dense samples
/// of the surface, and against the analytic torus.
#include "solids.h"

#include <algorithm>
#include <limits>
#include <thread>
#include <tuple>

namespace plumb::test {
namespace {

Contact* grow(void* ctx, std::uint32_t count) {
    auto& contacts = *static_cast<std::vector<Contact>*>(ctx);
    const std::size_t before = contacts.size();
    contacts.resize(before + count);
    return contacts.data() + before;
}

class Particles : public EachPlugin {
protected:
    void SetUp() override {
        EachPlugin::SetUp();
        if (IsSkipped()) return;
        World world(GetParam());
        std::vector<Contact> none;
        const ContactSink sink{&none, grow};
        if (world.collider().detect_particles({}, &sink, 1).code == Status::unsupported)
            GTEST_SKIP() << "the plugin tests no particles";
    }
};

struct Answer {
    std::vector<Contact> contacts;
    Status status;
};

/// All particles at once, after a detection at the world's poses.
Answer ask(World& world, const std::vector<V>& places, double radius, double margin,
           std::uint32_t group = ~0u, std::uint32_t mask = ~0u) {
    world.detect(0.01);
    std::vector<Vec3> positions;
    for (const V& p : places) positions.push_back(vec(p));
    const std::vector<double> radii(places.size(), radius);
    Answer answer;
    const ContactSink sink{&answer.contacts, grow};
    ParticleRequest request{positions.data(), radii.data(),
                            static_cast<std::uint32_t>(places.size()), 0, margin};
    request.group = group;
    request.mask = mask;
    answer.status = world.collider().detect_particles(request, &sink, 1);
    return answer;
}

/// What holds for every contact of a particle.
void expect_sound_contact(const Contact& c, const V& place, double radius, double margin) {
    EXPECT_NEAR(v(c.normal).norm(), 1, 1e-9);
    EXPECT_LE(c.gap, margin);
    EXPECT_EQ(v(c.point_a), place);
    EXPECT_EQ(c.radius_a, radius);
    EXPECT_NEAR(c.gap, v(c.normal).dot(v(c.point_a) - v(c.point_b)) - c.radius_a - c.radius_b,
                1e-9);
    EXPECT_NE(c.feature, 0u);
    EXPECT_NE(c.flags, 0u);
}

TEST_P(Particles, AgreeWithDenseSamplesOfEverySurface) {
    Dice dice(1);
    for (const Solid& solid : solids_of(GetParam())) {
        SCOPED_TRACE(solid.name);
        const Place place{V(1, -2, .5), dice.rotation()};
        World world(GetParam());
        ASSERT_EQ(world.add(3, solid.shape, place).code, Status::ok);
        std::vector<V> own, places;
        for (int i = 0; i < 150; ++i) own.push_back(dice.within(i % 2 ? .9 : .4));
        for (const V& p : own) places.push_back(place.x + place.q * p);
        const Answer answer = ask(world, places, .05, 10);
        EXPECT_EQ(answer.status.code, Status::ok);
        ASSERT_EQ(answer.contacts.size(), own.size());
        for (std::size_t i = 0; i < own.size(); ++i) {
            const Contact& c = answer.contacts[i];
            ASSERT_EQ(c.a, i);
            ASSERT_EQ(c.b, 3u);
            expect_sound_contact(c, places[i], .05, 10);
            const double distance = c.gap + .05;
            EXPECT_EQ(distance < 0, solid.inside(own[i])) << own[i].transpose();
            double nearest = 1e300;
            for (const V& s : solid.surface) nearest = std::min(nearest, (s - own[i]).norm());
            EXPECT_LE(std::abs(distance), nearest + 2e-3) << "samples of round shapes are chords";
            EXPECT_GE(std::abs(distance), nearest - solid.spacing);

            // The named point lies on the surface, and the normal looks out of it.
            const V on = v(c.point_b) + c.radius_b * v(c.normal), n = v(c.normal);
            const auto inside = [&](const V& p) {
                return solid.inside(place.q.conjugate() * (p - place.x));
            };
            EXPECT_FALSE(inside(on + 1e-7 * n));
            EXPECT_TRUE(distance >= 0 || inside(on - 1e-7 * n));
        }
    }
}

TEST_P(Particles, MeetClosedForms) {
    World world(GetParam());
    world.add(0, plane(), {V(0, -1, 0), Q::Identity()}, Mobility::fixed);
    world.add(1, sphere(.5), {});
    world.add(2, box(.5, .5, .5), {V(3, 0, 0), Q::Identity()});
    world.add(3, capsule(.2, .5), {V(6, 0, 0), Q::Identity()});
    struct Case {
        V place;
        std::uint32_t body;
        double distance;
        V normal;
    };
    const double s2 = std::sqrt(.5), s3 = std::sqrt(1 / 3.);
    const Case cases[] = {
        {V(20, -.9, 0), 0, .1, V::UnitY()},
        {V(20, -1.3, 0), 0, -.3, V::UnitY()},
        {V(0, 0, .6), 1, .1, V::UnitZ()},
        {V(0, -.1, 0), 1, -.4, -V::UnitY()},
        {V(3, .55, .1), 2, .05, V::UnitY()},
        {V(3.6, .6, .1), 2, std::sqrt(.02), V(s2, s2, 0)},
        {V(3.6, .6, -.6), 2, std::sqrt(.03), V(s3, s3, -s3)},
        {V(2.9, .1, -.45), 2, -.05, -V::UnitZ()},
        {V(6.3, .2, 0), 3, .1, V::UnitX()},
        {V(6, .6, .1), 3, std::sqrt(.02) - .2, V(0, s2, s2)},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.place.transpose());
        const Answer answer = ask(world, {c.place}, .01, .3);
        const Contact* found = nullptr;
        for (const Contact& contact : answer.contacts)
            if (contact.b == c.body) found = &contact;
        ASSERT_TRUE(found);
        expect_sound_contact(*found, c.place, .01, .3);
        EXPECT_NEAR(found->gap, c.distance - .01, 1e-12);
        EXPECT_LT((v(found->normal) - c.normal).norm(), 1e-12);
    }
}

TEST_P(Particles, KnowTheInsideOfATorus) {
    PLUMB_NEEDS_CLAIM(ShapeKind::mesh, ShapeKind::sphere);
    const double major = .5, minor = .2;
    const int around = 96, across = 48;
    const double sagitta =
        minor * (1 - std::cos(M_PI / across)) + (major + minor) * (1 - std::cos(M_PI / around));
    Dice dice(2);
    const Place place{V(.3, .1, -2), dice.rotation()};
    World world(GetParam());
    world.add(0, torus_mesh(major, minor, around, across), place);
    std::vector<V> own, places;
    for (int i = 0; i < 2000; ++i) own.push_back(dice.within(.75).cwiseProduct(V(1, .4, 1)));
    for (const V& p : own) places.push_back(place.x + place.q * p);
    const Answer answer = ask(world, places, 0, 10);
    ASSERT_EQ(answer.contacts.size(), own.size());
    int inside = 0;
    for (std::size_t i = 0; i < own.size(); ++i) {
        const double exact =
            std::hypot(std::hypot(own[i].x(), own[i].z()) - major, own[i].y()) - minor;
        EXPECT_NEAR(answer.contacts[i].gap, exact, sagitta) << own[i].transpose();
        inside += answer.contacts[i].gap < 0;
    }
    EXPECT_GT(inside, 200);
}

TEST_P(Particles, TouchAVertexOfATorusOnce) {
    PLUMB_NEEDS_CLAIM(ShapeKind::mesh, ShapeKind::sphere);
    const Shape torus = torus_mesh(.5, .2, 24, 12);
    World world(GetParam());
    world.add(0, torus, {});
    for (std::uint32_t k = 0; k < torus.vertex_count; k += 7) {
        const V vertex = v(torus.vertices[k]);
        const V middle = .5 * V(vertex.x(), 0, vertex.z()).normalized();
        const V out = (vertex - middle).normalized();
        for (double height : {.01, 1e-6, 0.0, -1e-6, -.02}) {
            SCOPED_TRACE(height);
            const Answer answer = ask(world, {vertex + height * out}, .05, .01);
            ASSERT_EQ(answer.contacts.size(), 1u);
            const Contact& c = answer.contacts[0];
            // Beside the vertex a face may be nearer, by the cosine of what it is tilted.
            const double share = height ? (c.gap + .05) / height : 1;
            EXPECT_NEAR(c.gap + .05, height, .07 * std::abs(height) + 1e-12);
            EXPECT_LT(share, 1 + 1e-9);
            EXPECT_GT(v(c.normal).dot(out), .9);
        }
    }
}

TEST_P(Particles, MeetASheetFromBothSides) {
    PLUMB_NEEDS_CLAIM(ShapeKind::mesh, ShapeKind::sphere);
    World world(GetParam());
    world.add(0, grid_mesh(1, 4), {}, Mobility::fixed);
    const Answer answer = ask(world, {V(.1, .02, .3), V(.1, -.02, .3), V(1.03, .04, 0)}, .1, 0);
    ASSERT_EQ(answer.contacts.size(), 3u);
    EXPECT_NEAR(answer.contacts[0].gap, -.08, 1e-12);
    EXPECT_NEAR(answer.contacts[1].gap, -.08, 1e-12);
    EXPECT_NEAR(answer.contacts[2].gap, -.05, 1e-12);
    EXPECT_NEAR(answer.contacts[0].normal.y, 1, 1e-12);
    EXPECT_NEAR(answer.contacts[1].normal.y, -1, 1e-12);
    EXPECT_NEAR(answer.contacts[2].normal.x, .6, 1e-12);
}

TEST_P(Particles, TouchEveryPartOfACompound) {
    World world(GetParam());
    world.add(5,
              compound({{box(.5, .5, .5), {V(-.6, 0, 0), Q::Identity()}},
                        {sphere(.5), {V(.6, 0, 0), Q::Identity()}}}),
              {V(0, 1, 0), Q::Identity()});
    const Answer answer = ask(world, {V(0, 1, 0), V(-.6, 1.6, 0)}, .15, 0);
    ASSERT_EQ(answer.contacts.size(), 3u);
    for (const Contact& c : answer.contacts) {
        EXPECT_EQ(c.b, 5u);
        EXPECT_NEAR(c.gap, -.05, 1e-12);
    }
    EXPECT_EQ(answer.contacts[0].part_b + answer.contacts[1].part_b, 1u);
    EXPECT_LT(answer.contacts[0].feature, answer.contacts[1].feature);
}

/// Bodies of all solids of the plugin, thrown together.
struct Crowd {
    std::vector<std::pair<Shape, Place>> bodies;
    explicit Crowd(const std::string& plugin, Dice& dice) {
        const std::vector<Solid> solids = solids_of(plugin);
        for (std::uint32_t i = 0; i < 60; ++i)
            bodies.push_back(
                {solids[i % solids.size()].shape, {dice.within(1.2), dice.rotation()}});
    }
    void add_to(World& world) const {
        for (std::uint32_t i = 0; i < bodies.size(); ++i)
            world.add(2 * i, bodies[i].first, bodies[i].second);
    }
};

TEST_P(Particles, InACrowdTouchWhatTheyTouchAlone) {
    Dice dice(3);
    const Crowd crowd(GetParam(), dice);
    std::vector<V> places;
    for (int i = 0; i < 400; ++i) places.push_back(dice.within(1.5));
    World all(GetParam());
    crowd.add_to(all);
    const Answer together = ask(all, places, .1, .02);
    std::vector<Contact> apart;
    for (std::uint32_t i = 0; i < crowd.bodies.size(); ++i) {
        World one(GetParam());
        one.add(2 * i, crowd.bodies[i].first, crowd.bodies[i].second);
        const Answer answer = ask(one, places, .1, .02);
        apart.insert(apart.end(), answer.contacts.begin(), answer.contacts.end());
    }
    const auto before = [](const Contact& p, const Contact& q) {
        return std::tie(p.a, p.b, p.feature) < std::tie(q.a, q.b, q.feature);
    };
    std::sort(apart.begin(), apart.end(), before);
    EXPECT_GT(apart.size(), 200u);
    EXPECT_TRUE(std::is_sorted(together.contacts.begin(), together.contacts.end(), before));
    ASSERT_EQ(together.contacts.size(), apart.size());
    for (std::size_t i = 0; i < apart.size(); ++i) {
        EXPECT_EQ(together.contacts[i].a, apart[i].a);
        EXPECT_EQ(together.contacts[i].b, apart[i].b);
        EXPECT_EQ(together.contacts[i].feature, apart[i].feature);
        EXPECT_EQ(together.contacts[i].gap, apart[i].gap);
    }
}

/// Threads of the test's own.
void run_threads(void*, void (*task)(void*, std::uint32_t), void* arg) {
    std::vector<std::thread> threads;
    for (std::uint32_t i = 0; i < 3; ++i) threads.emplace_back(task, arg, i);
    for (std::thread& t : threads) t.join();
}

TEST_P(Particles, OnThreeThreadsAnswerAsOnOne) {
    Dice dice(4);
    const Crowd crowd(GetParam(), dice);
    World world(GetParam(), 3);
    crowd.add_to(world);
    std::vector<V> places;
    for (int i = 0; i < 400; ++i) places.push_back(dice.within(1.5));
    const Answer one = ask(world, places, .1, .02);

    std::vector<Vec3> positions;
    for (const V& p : places) positions.push_back(vec(p));
    const std::vector<double> radii(places.size(), .1);
    std::vector<Contact> found[3];
    const ContactSink sinks[] = {{&found[0], grow}, {&found[1], grow}, {&found[2], grow}};
    const TaskRunner runner{nullptr, 3, run_threads};
    ParticleRequest request{positions.data(), radii.data(), 400, 0, .02};
    request.runner = &runner;
    EXPECT_EQ(world.collider().detect_particles(request, sinks, 3).code, Status::ok);
    for (const auto& share : found) EXPECT_GT(share.size(), 20u);
    found[0].insert(found[0].end(), found[1].begin(), found[1].end());
    found[0].insert(found[0].end(), found[2].begin(), found[2].end());
    ASSERT_EQ(found[0].size(), one.contacts.size());
    for (std::size_t i = 0; i < found[0].size(); ++i) {
        EXPECT_EQ(found[0][i].a, one.contacts[i].a);
        EXPECT_EQ(found[0][i].feature, one.contacts[i].feature);
        EXPECT_EQ(found[0][i].gap, one.contacts[i].gap);
    }
}

TEST_P(Particles, HeedGroupsAndMasks) {
    World world(GetParam());
    world.add(0, sphere(.5), {}, Mobility::fixed, 1, 6);
    EXPECT_EQ(ask(world, {V(0, .5, 0)}, .1, 0).contacts.size(), 1u);
    EXPECT_EQ(ask(world, {V(0, .5, 0)}, .1, 0, 2, 1).contacts.size(), 1u);
    EXPECT_EQ(ask(world, {V(0, .5, 0)}, .1, 0, 1, 1).contacts.size(), 0u);
    EXPECT_EQ(ask(world, {V(0, .5, 0)}, .1, 0, 2, 2).contacts.size(), 0u);
}

TEST_P(Particles, FollowTheBodies) {
    World world(GetParam());
    world.add(0, sphere(.5), {});
    EXPECT_EQ(ask(world, {V(4, 0, 0)}, .1, 0).contacts.size(), 0u);
    world.move(0, {V(4, 0, 0), Q::Identity()});
    EXPECT_EQ(ask(world, {V(4, 0, 0)}, .1, 0).contacts.size(), 1u);
    world.collider().remove(0);
    EXPECT_EQ(ask(world, {V(4, 0, 0)}, .1, 0).contacts.size(), 0u);
}

TEST_P(Particles, WithBadNumbersAreLeftOut) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    World world(GetParam());
    world.add(0, plane(), {}, Mobility::fixed);
    world.add(1, box(1, 1, 1), {});
    const Answer answer =
        ask(world, {V(nan, 0, 0), V(0, -.1, 0), V(0, 1 / 0.0, 0), V(9, .05, 9)}, .1, 0);
    EXPECT_EQ(answer.status.code, Status::bad_argument);
    EXPECT_EQ(answer.status.count, 2u);
    EXPECT_TRUE(answer.status.message);
    ASSERT_EQ(answer.contacts.size(), 3u);
    EXPECT_EQ(answer.contacts[0].a, 1u);
    EXPECT_EQ(answer.contacts[2].a, 3u);
    EXPECT_EQ(ask(world, {V(0, 0, 0)}, -1, 0).status.code, Status::bad_argument);
    EXPECT_EQ(ask(world, {V(0, 0, 0)}, nan, 0).status.code, Status::bad_argument);
    EXPECT_EQ(ask(world, {V(0, 0, 0)}, .1, -1).status.code, Status::bad_argument);
    EXPECT_EQ(ask(world, {V(0, 0, 0)}, .1, nan).status.code, Status::bad_argument);
    EXPECT_EQ(ask(world, {}, .1, 0).status.code, Status::ok);

    // A body whose pose is lost touches nothing.
    world.move(1, {V(nan, 0, 0), Q::Identity()});
    EXPECT_EQ(ask(world, {V(0, 5, 0)}, .1, 10).contacts.size(), 1u);
}

PLUMB_FOR_EACH_PLUGIN(Particles);

}  // namespace
}  // namespace plumb::test
