// SPDX-License-Identifier: MIT
/// What swings on massless rods, which are distance joints: under any load, and held beside its
/// centre of mass.
#include "support/random.h"
#include "support/scenes.h"
#include "support/swings.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

class MasslessRods : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, MasslessRods, each_precision(), precision_name);

/// One to four bodies on rods without mass, each held beside its centre of mass.
void add_rods(Scene& s, Random& random) {
    const std::uint32_t count = 1 + random.below(4);
    Vector held = Vector::Zero();
    for (std::uint32_t i = 0; i < count; ++i) {
        const double size = random.number(0.03, 0.1);
        const Vector point = held + random.number(0.1, 0.4) * random.direction();
        BodySpec& body = add_body(s, box(size, random.number(0.5, 1) * size, size),
                                  point + random.number(0, 1.5) * size * random.direction());
        body.mass = random.number(0.2, 5);
        body.placement.rotation = random.rotation();
        JointSpec joint;
        joint.kind = JointKind::distance;
        joint.body_a = i, joint.body_b = i > 0 ? i - 1 : kNoIndex;
        joint.anchor = point, joint.anchor_b = held;
        s.joints.push_back(joint);
        held = body.placement.position;
    }
}

/// What hangs on them whips round where its centre comes near to the line of its rod.
TEST_P(MasslessRods, WhatWhipsRoundOnThemKeepsItsEnergy) {
    Random random(23);
    for (int draw = 0; draw < 30; ++draw) {
        Scene s = still_scene(GetParam());
        add_rods(s, random);
        if (draw % 3 == 1) use_fine_steps(s.settings);
        if (draw % 3 == 2)
            s.settings.dt = random.number(0.002, 0.01), s.settings.substeps = 1 + random.below(20);
        Simulation simulation(s, colliders(), "reference");
        const double before = total_energy(simulation);
        double fastest = 0;
        while (simulation.time() < 10) {
            ASSERT_TRUE(simulation.step().finite);
            fastest = std::max(fastest, kinetic_energy(simulation.world()));
        }
        // velocities are up to half a substep behind places, of what divides its substep less
        const double half = 0.5 * s.settings.dt / s.settings.substeps;
        double late = 0;
        for (std::size_t i = 0; i < simulation.world().bodies.size(); ++i)
            late += half * 9.81 * simulation.world().bodies.mass[i] *
                    simulation.world().bodies.velocity[i].y();
        const double gained = total_energy(simulation) - before;
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << s.joints.size() << " rods, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        EXPECT_GT(std::max(gained, gained - late), -0.01 * fastest);
        EXPECT_LT(std::min(gained, gained - late), 0.01 * fastest);
    }
}

/// One to five bodies on rods in a line, let go at 5 to 90°; the last weighs 3 to 10,000 times as
/// much as the others.
void add_loaded_rods(Scene& s, Random& random) {
    const std::uint32_t count = 1 + random.below(5);
    const double size = random.number(0.05, 0.5), angle = random.number(5, 90) / 57.29578;
    const double load = std::pow(10, random.number(0.5, 4));
    const Vector along(std::sin(angle), -std::cos(angle), 0);
    double held = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double half = 0.5 * size * random.number(0.2, 0.5);
        const double rod = size * random.number(0.3, 1);
        const Vector at = along * (held + rod + half);
        const bool round = random.below(2) == 0;
        BodySpec& body = round ? add_body(s, sphere(half), at)
                               : add_body(s, box(0.3 * half, half, 0.3 * half), at);
        body.mass = i + 1 == count ? load : random.number(0.5, 2);
        body.placement.rotation = rotation_between(-Vector::UnitY(), along);
        JointSpec joint;
        joint.kind = JointKind::distance;
        joint.body_a = i, joint.body_b = i > 0 ? i - 1 : kNoIndex;
        joint.anchor = along * (held + rod), joint.anchor_b = Vector(along * held);
        s.joints.push_back(joint);
        held += rod + 2 * half;
    }
}

/// Or the step says that it could not follow.
TEST_P(MasslessRods, KeepTheirEnergyUnderAnyLoad) {
    Random random(GetParam() == Precision::single ? 51 : 52);
    int told = 0;
    for (int draw = 0; draw < 30; ++draw) {
        Scene s = still_scene(GetParam());
        add_loaded_rods(s, random);
        if (draw % 3 == 1) use_fine_steps(s.settings);
        if (draw % 3 == 2)
            s.settings.dt = random.number(0.002, 0.02), s.settings.substeps = 1 + random.below(20);
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << s.joints.size() << " rods, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        std::uint32_t coarse = 0;
        const double left = energy_left(s, lowest_energy(s), &coarse, 20);
        EXPECT_TRUE(std::abs(left - 1) < 0.01 || coarse > 0) << left << " without a word";
        EXPECT_LT(left, 1.01);
        told += coarse > 0;
    }
    EXPECT_LE(told, 2) << "of 30";
}

}  // namespace
}  // namespace plumb::test
