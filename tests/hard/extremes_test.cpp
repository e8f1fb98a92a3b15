// SPDX-License-Identifier: MIT
/// Far from the origin, fast spins, long and tiny steps.
#include "scene/error.h"
#include "support/scenes.h"

#include <algorithm>

namespace plumb::test {
namespace {

TEST(Extremes, SpinOfAThousandRadiansASecondKeepsItsEnergy) {
    for (const Vector& axis :
         {Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1), Vector(1, 2, 3).normalized().eval()}) {
        Scene s;
        s.settings.gravity.setZero();
        s.settings.dt = 2e-4;  // h ω = 0.2
        add_body(s, box(0.1, 0.2, 0.3), Vector::Zero()).angular_velocity = 1000 * axis;
        Simulation simulation(s, colliders(), "reference");
        const double e0 = kinetic_energy(simulation.world());
        run_for(simulation, 1);
        EXPECT_NEAR(kinetic_energy(simulation.world()) / e0, 1, 0.01);
    }
}

/// Where five sliding boxes come to rest, relative to where they started.
std::vector<Vector> slide_at(const Vector& where, Precision precision) {
    Scene s;
    s.settings.precision = precision;
    add_body(s, box(5, 1, 5), where + Vector(0, -1, 0), Motion::fixed);
    for (int i = 0; i < 5; ++i)
        add_body(s, box(0.25, 0.25, 0.25), where + Vector(i - 2.0, 0.3 + 0.1 * i, 0)).velocity = {
            0, 0, 1};
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 2);
    std::vector<Vector> result;
    for (const Vector& x : simulation.world().bodies.position) result.push_back(x - where);
    return result;
}

TEST(Extremes, TenKilometresFromTheOriginInSinglePrecision) {
    const std::vector<Vector> here = slide_at(Vector::Zero(), Precision::single);
    const std::vector<Vector> there = slide_at(Vector(1e4, 0, 1e4), Precision::single);
    for (std::size_t i = 0; i < here.size(); ++i)
        EXPECT_LT((here[i] - there[i]).norm(), 1e-3) << "body " << i;
}

TEST(Extremes, LongStepsStayBounded) {
    Scene s;
    s.settings.dt = 0.1;
    add_ground(s);
    for (int i = 0; i < 3; ++i) add_body(s, box(0.5, 0.5, 0.5), {0, 0.6 + 1.05 * i, 0});
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 10);
    for (double depth : penetrations(simulation.world()))
        EXPECT_LT(depth, 0.1) << "a tenth of the size";
}

/// A cube that drops from five times its height, tilted.
Scene dropped_cube(double half) {
    Scene s;
    add_ground(s);
    BodySpec& cube = add_body(s, box(half, half, half), {0, 11 * half, 0});
    cube.placement.rotation = Rotation(Eigen::AngleAxisd(0.7, Vector(1, 0.3, 0.2).normalized()));
    return s;
}

TEST(Extremes, TheSmallestBodiesOfAStepComeToRest) {
    const double limit = 9.81 * 0.01 * 0.01 / 25 / std::sqrt(3.0);  // half a cube's side [m]
    const Scene s = dropped_cube(1.01 * limit);
    ASSERT_EQ(s.settings.dt, 0.01);
    for (const char* name : {"reference", "ode", "bullet", "fcl"}) {
        Simulation simulation(s, colliders(), name);
        run_for(simulation, 1);
        EXPECT_NEAR(simulation.world().bodies.position[1].y(), limit, 0.05 * limit) << name;
    }
}

TEST(Extremes, BodiesTooSmallForTheStepAreRefused) {
    Scene s = dropped_cube(1e-6);
    const auto sentence = [&s]() -> std::string {
        try {
            const Simulation simulation(s, colliders(), "reference");
        } catch (const SceneError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(sentence(),
              "/bodies/1/shape: the body reaches only 1.7e-06 m from its centre, and gravity moves "
              "it by 0.00098 m in a step of 0.01 s: the step may be 0.0021 s at most, or the body "
              "must reach 3.9e-05 m");
    s.settings.dt = 0.002;
    EXPECT_EQ(sentence(), "");
    s.settings.dt = 0.01;
    s.settings.gravity.setZero();
    EXPECT_EQ(sentence(), "");
}

TEST(Extremes, JointAtTheCentreOfMassAndJointBetweenCoincidentBodies) {
    Scene s;
    use_fine_steps(s.settings);
    add_body(s, box(0.1, 0.2, 0.3), Vector::Zero()).angular_velocity = {1, 2, 3};
    add_body(s, box(0.1, 0.2, 0.3), Vector::Zero()).mask = 0;
    for (std::uint32_t i = 0; i < 2; ++i) {
        JointSpec joint;
        joint.body_a = i;
        joint.body_b = i == 0 ? kNoIndex : 0;
        joint.anchor = Vector::Zero();
        s.joints.push_back(joint);
    }
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 5);
    for (double error : joint_errors(simulation.world())) EXPECT_LT(error, 1e-3);
}

}  // namespace
}  // namespace plumb::test
