// SPDX-License-Identifier: MIT
/// Rods between bodies, in chains and in loops, and coupled wheels: they keep their lengths and
/// energy at settings drawn at random.
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/soft.h"

#include <cmath>

namespace plumb::test {
namespace {

class Trusses : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, Trusses, each_precision(), precision_name);

double drawn_mass(Random& random, double most) {
    return std::exp(random.number(0, std::log(most)));
}

/// What a run keeps: the mean energy above `base` [J] of its last fifth over that of its first, and
/// the widest gap of a joint [m].
struct Kept {
    double energy, widest = 0;
};
Kept run_and_measure(Simulation& simulation, double base, double seconds) {
    Kept kept{};
    double first = 0, last = 0;
    int of_first = 0, of_last = 0;
    while (simulation.time() < seconds) {
        simulation.step();
        for (const double e : joint_errors(simulation.world()))
            kept.widest = std::max(kept.widest, e);
        const double energy = total_energy(simulation) - base;
        if (simulation.time() < 0.2 * seconds) first += energy, ++of_first;
        if (simulation.time() > 0.8 * seconds) last += energy, ++of_last;
    }
    kept.energy = (last / of_last) / (first / of_first);
    return kept;
}

/// Two to six bodies, from 1 to 50 kg, each on a rod of the one before, thrown or hung.
TEST_P(Trusses, ChainsOfRodsKeepTheirEnergyAndLength) {
    Random random(5);
    for (int draw = 0; draw < 30; ++draw) {
        Scene s;
        s.settings.precision = GetParam();
        s.settings.forbid = {"contacts"};
        const bool hangs = draw % 2 == 0;
        if (!hangs) s.settings.gravity.setZero();
        const std::uint32_t count = 2 + random.below(5);
        double lowest = 0;  // potential energy of the chain that hangs straight down, about
        Vector before = Vector::Zero();
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vector way =
                hangs ? Vector(std::sin(0.5), -std::cos(0.5), 0) : Vector(random.direction());
            const Vector at = before + 0.8 * way;
            BodySpec& body = add_body(s, sphere(0.15), at);
            body.mass = drawn_mass(random, 50);
            if (!hangs) body.velocity = random.vector();
            lowest -= *body.mass * kGravity * 0.8 * (i + 1);
            if (i > 0)
                add_link(s, on_body(i, at), on_body(i - 1, before));
            else if (hangs)
                add_link(s, on_body(i, at), in_the_world(before));
            before = at;
        }
        draw_settings(s.settings, random, draw);
        SCOPED_TRACE(draw);
        Simulation simulation(s, colliders(), "reference");
        const Kept kept = run_and_measure(simulation, hangs ? lowest : 0, 10);
        EXPECT_NEAR(kept.energy, 1, 0.01);
        EXPECT_LT(kept.widest, 1e-5);
    }
}

/// Triangles and tetrahedra of rods, whose loops are closed exactly, tumble in free space.
TEST_P(Trusses, LoopsOfRodsKeepTheirEnergyAndLength) {
    Random random(6);
    for (int draw = 0; draw < 30; ++draw) {
        Scene s;
        s.settings.precision = GetParam();
        s.settings.forbid = {"contacts"};
        s.settings.gravity.setZero();
        const Vector corners[] = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0.87}, {0.5, 0.82, 0.29}};
        const std::uint32_t count = 3 + draw % 2;
        const Rotation turn = random.rotation();
        const Vector spin = random.vector(2);
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vector at = turn * corners[i];
            BodySpec& body = add_body(s, sphere(0.1), at);
            body.mass = drawn_mass(random, 50);
            body.velocity = spin.cross(at);
            for (std::uint32_t j = 0; j < i; ++j)
                add_link(s, on_body(i, at), on_body(j, turn * corners[j]));
        }
        draw_settings(s.settings, random, draw);
        SCOPED_TRACE(draw);
        Simulation simulation(s, colliders(), "reference");
        const double start = total_energy(simulation);
        double widest = 0;
        while (simulation.time() < 10) {
            simulation.step();
            for (const double e : joint_errors(simulation.world())) widest = std::max(widest, e);
        }
        EXPECT_NEAR(total_energy(simulation) / start, 1, 0.01);
        EXPECT_LT(widest, 1e-5);
    }
}

/// Twelve balls, each on rods to all near ones, which are more than hold them: they fall, and are
/// braced and shaken, but not driven.
TEST_P(Trusses, ALatticeThatFallsGainsNothing) {
    Random random(8);
    for (int draw = 0; draw < 9; ++draw) {
        Scene s;
        s.settings.precision = GetParam();
        add_ground(s);
        const Rotation turn = random.rotation();
        std::vector<Vector> places;
        const double most = std::pow(10, random.number(0, 2));
        for (std::uint32_t i = 0; i < 12; ++i) {
            places.push_back(turn * Vector(i % 3, i / 3 % 2, i / 6) + Vector(0, 3, 0));
            add_body(s, sphere(0.1), places[i]).mass = drawn_mass(random, most);
            for (std::uint32_t j = 0; j < i; ++j)
                if ((places[i] - places[j]).norm() < 1.5)
                    add_link(s, on_body(1 + i, places[i]), on_body(1 + j, places[j]));
        }
        draw_settings(s.settings, random, draw);
        SCOPED_TRACE(draw);
        Simulation simulation(s, colliders(), "reference");
        const double start = total_energy(simulation);
        while (simulation.time() < 4) {
            simulation.step();
            ASSERT_LT(total_energy(simulation), 1.001 * start);
            for (const double e : joint_errors(simulation.world())) ASSERT_LT(e, 0.05);
        }
    }
}

/// Wheels that are out of balance and geared to each other swing about their lowest place.
TEST_P(Trusses, CoupledWheelsKeepTheirEnergy) {
    Random random(7);
    for (int draw = 0; draw < 20; ++draw) {
        Scene s;
        s.settings.precision = GetParam();
        s.settings.forbid = {"contacts"};
        const std::uint32_t count = 2 + random.below(3);
        double lowest = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vector centre(i, 0, 0);
            const double arm = random.number(0.1, 0.3), angle = random.number(0, 6);
            BodySpec& body = add_body(s, box(0.2, 0.1, 0.05),
                                      centre + arm * Vector(std::cos(angle), std::sin(angle), 0));
            body.mass = drawn_mass(random, 50), body.mask = body.group = 0;
            lowest -= *body.mass * kGravity * arm;
            JointSpec hinge;
            hinge.kind = JointKind::hinge, hinge.body_a = i, hinge.anchor = centre;
            hinge.frame = rotation_between(Vector::UnitX(), Vector::UnitZ());
            s.joints.push_back(hinge);
            if (i == 0) continue;
            CouplingSpec gear;
            gear.joint_a = i - 1, gear.joint_b = i;
            gear.ratio = (random.below(2) ? 1 : -1) * random.number(0.3, 3);
            s.couplings.push_back(gear);
        }
        draw_settings(s.settings, random, draw);
        SCOPED_TRACE(draw);
        Simulation simulation(s, colliders(), "reference");
        EXPECT_NEAR(run_and_measure(simulation, lowest, 20).energy, 1, 0.02);
    }
}

}  // namespace
}  // namespace plumb::test
