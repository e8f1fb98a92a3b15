// SPDX-License-Identifier: MIT
/// Contacts that are kept from step to step against those of a detection that knows no step before:
/// while a heap falls into a bin, and while it comes to rest.
#include "host/contact_source.h"
#include "support/binned_heap.h"
#include "support/draw_settings.h"

#include <map>
#include <set>

namespace plumb::test {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;
using Gaps = std::map<Pair, double>;  ///< the least of each pair [m]

Gaps least_gaps(const std::vector<Contact>& contacts) {
    Gaps gaps;
    for (const Contact& c : contacts) {
        const auto [at, is_new] = gaps.insert({{c.a, c.b}, c.gap});
        at->second = std::min(at->second, c.gap);
    }
    return gaps;
}

/// Balls and boxes: contacts of what has a rim, or is cut at random, jump with the least turn.
Scene heap_in_bin(Random& random, std::uint32_t count) {
    Scene s;
    add_bin(s, 0.6);
    const double r = random.number(0.03, 0.07);
    add_layers(s, {box(r, random.number(0.02, 0.08), r), sphere(random.number(0.03, 0.08))}, count);
    return s;
}

struct Compared {
    std::size_t pairs = 0, kept = 0;
    double worst = 0;  ///< difference of least gaps [m]
};

/// Compares the table of the last step with what is detected anew at its poses.
void compare(const Simulation& simulation, ContactSource& source, Compared& sum) {
    const Settings& settings = simulation.world().settings;
    const ContactTable& table = simulation.world().contacts;
    const Gaps kept = least_gaps(table.found);
    std::set<Pair> turned;
    for (std::size_t i = 0; i < table.found.size(); ++i)
        if (table.memory[i].flush) turned.insert({table.found[i].a, table.found[i].b});
    for (const auto& [pair, gap] :
         least_gaps(source.ask({table.kept.seen, settings.margin, false}).contacts)) {
        const auto at = kept.find(pair);
        if (at == kept.end()) {
            ASSERT_GE(gap, settings.margin / 2) << pair.first << " and " << pair.second;
            continue;
        }
        if (turned.contains(pair)) continue;  // into the plane of another pair
        ++sum.pairs;
        sum.worst = std::max(sum.worst, std::abs(at->second - gap));
    }
    sum.kept += table.kept.reused;
}

class KeptContacts : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(, KeptContacts, testing::Values("reference", "ode", "bullet", "fcl"),
                         [](const auto& param_info) { return param_info.param; });

TEST_P(KeptContacts, AreThoseOfADetectionAnew) {
    Random random(7);
    for (int draw = 0; draw < 3; ++draw) {
        Scene s = heap_in_bin(random, 45);
        draw_settings(s.settings, random, draw);
        Simulation simulation(s, colliders(), GetParam());
        LocalSource source(s, colliders(), GetParam());
        Compared sum;
        while (simulation.time() < 2.5) {
            simulation.step();
            if (simulation.steps() % 3 == 0) compare(simulation, source, sum);
            if (HasFatalFailure()) return;
        }
        EXPECT_GT(sum.kept, sum.pairs / 10) << "draw " << draw;
        EXPECT_LE(sum.worst, s.settings.reuse_distance) << "draw " << draw;
    }
}

/// What comes as fast as it can from just beyond the margin is stopped where it touches.
TEST_P(KeptContacts, OfWhatComesSlowlyOrFastAreThereInTime) {
    Random random(8);
    for (int draw = 0; draw < 30; ++draw) {
        Scene s;
        s.settings.gravity = Vector::Zero();
        draw_settings(s.settings, random, draw);
        const double r = random.number(0.05, 0.5), speed = std::pow(10, random.number(-3, 1)),
                     gap = random.number(0.5, 3) * s.settings.margin;
        add_body(s, sphere(r), {0, 0, 0}, Motion::fixed);
        add_body(s, random.below(2) ? sphere(r) : box(r, r, r), {2 * r + gap, 0, 0}).velocity = {
            -speed, 0, 0};
        Simulation simulation(s, colliders(), GetParam());
        double nearest = gap;
        while (simulation.time() < 2 * gap / speed) {
            simulation.step();
            nearest = std::min(nearest, simulation.world().bodies.position[1].x() - 2 * r);
        }
        EXPECT_GT(nearest, -1e-6) << "draw " << draw << ", " << speed << " m/s from " << gap;
    }
}

/// A ball comes near another one aslant, so that the two are candidates before they are within the
/// margin, and waits there. Then it is suddenly pushed, or a keyframe sets the other one going:
/// without reuse their contact would be known all the time.
TEST_P(KeptContacts, OfWhatIsSetGoingSuddenlyAreThereInTime) {
    constexpr double kRadius = 0.1;
    const Vector along = Vector(1, 1, 1).normalized();
    Random random(9);
    for (int draw = 0; draw < 20; ++draw) {
        const bool by_force = draw % 2 == 1;
        Scene s;
        s.settings.gravity = Vector::Zero();
        s.settings.dt = random.number(0.005, 0.02);
        const double margin = s.settings.margin, start = 60 * s.settings.dt;
        add_body(s, sphere(kRadius), {0, 0, 0}, Motion::kinematic);
        if (!by_force) {
            const auto at = [&](double x) { return Placement{x * along, Rotation::Identity()}; };
            s.bodies[0].script.keyframes = {{0, at(0)}, {start, at(0)}, {2 * start, at(1)}};
        }
        const double gap = random.number(0.55, 0.95) * margin,
                     speed = 0.03 * margin / s.settings.dt;
        add_body(s, sphere(kRadius), (2 * kRadius + 1.3 * margin) * along);
        double least[2] = {1, 1};
        for (const bool reuse : {false, true}) {
            s.settings.reuse_distance = reuse ? Settings{}.reuse_distance : 0;
            Simulation simulation(s, colliders(), GetParam());
            const Bodies& b = simulation.world().bodies;
            const auto gap_now = [&] {
                return (b.position[1] - b.position[0]).norm() - 2 * kRadius;
            };
            while (simulation.time() < 2 * start - 1e-9) {
                const double comes = gap_now() > gap ? -speed : 0;
                if (simulation.time() < start - 1e-9)
                    simulation.set_velocity(b.id[1], comes * along, Vector::Zero());
                else if (by_force)
                    simulation.set_force(b.id[1], -400 * along, Vector::Zero());
                simulation.step();
                least[reuse] = std::min(least[reuse], gap_now());
            }
        }
        EXPECT_GT(least[1], std::min(least[0], 0.0) - 0.02 * margin) << "draw " << draw;
    }
}

}  // namespace
}  // namespace plumb::test
