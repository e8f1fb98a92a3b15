// SPDX-License-Identifier: MIT
/// Small scenes made by hand, and every collider and precision to run them on.
#pragma once

#include "host/simulation.h"
#include "math/rotation_between.h"
#include "measure/measure.h"
#include "scene/build.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

namespace plumb::test {

using Vector = Eigen::Vector3d;
using Rotation = Eigen::Quaterniond;

inline constexpr double kGravity = 9.81;  ///< of a scene that does not say [m/s²]

inline const ColliderLibrary& colliders() {
    static const ColliderLibrary library(PLUMB_TEST_PLUGINS);
    return library;
}

/// 60 Hz with 20 substeps of one iteration each: the finest that the laws may take.
inline void use_fine_steps(Settings& s) {
    s.dt = 1.0 / 60;
    s.substeps = 20;
    s.velocity_iterations = s.position_iterations = 1;
}

inline void run_for(Simulation& simulation, double seconds) {
    const auto steps = std::llround(seconds / simulation.world().settings.dt);
    for (long long i = 0; i < steps; ++i) {
        const StepReport report = simulation.step();
        ASSERT_TRUE(report.finite);
        ASSERT_FALSE(report.collider_failed) << report.message;
    }
}

/// Saves the scene after `before` [s] and goes on for `after` [s], and with it a copy on other
/// threads and lanes, which is to have the same bits. Returns the first.
inline Simulation goes_on_bit_for_bit(Scene s, double before, double after) {
    s.settings.threads = 1;
    Simulation one(s, colliders(), "reference");
    s.settings.threads = 3, s.settings.lanes = 1;
    Simulation two(s, colliders(), "reference");
    run_for(one, before);
    two.restore(one.save());
    run_for(one, after), run_for(two, after);
    EXPECT_EQ(state_hash(two.world()), state_hash(one.world()));
    return one;
}

/// The longest way of any body from where it was [m].
inline double farthest_from(const std::vector<Vector>& start, const World& world) {
    double most = 0;
    for (std::size_t i = 0; i < start.size(); ++i)
        most = std::max(most, (world.bodies.position[i] - start[i]).norm());
    return most;
}

/// Where a joint stands along an axis [m] or [rad].
inline double joint_position(const Simulation& s, std::uint32_t joint, std::uint32_t axis) {
    return s.joint_motion(joint, axis).position;
}

/// Fastest motion of any point of a body [m/s].
inline double fastest_point(const World& world) {
    const Bodies& b = world.bodies;
    double most = 0;
    for (std::size_t i = 0; i < b.size(); ++i)
        if (b.motion[i] == Motion::dynamic)
            most = std::max(
                most, b.velocity[i].norm() + b.angular_velocity[i].norm() * b.bounding_radius[i]);
    return most;
}

/// How far the worst joint is open [m], [rad].
inline double widest_joint(const World& world) {
    const std::vector<double> errors = joint_errors(world);
    return errors.empty() ? 0 : *std::max_element(errors.begin(), errors.end());
}

/// How anything moves: the fastest point [m/s], and the longest way of any body [m].
struct Motions {
    double fastest = 0, farthest = 0;
};

/// Runs from now until `settled` [s], and on until `end`; says how anything moved after `settled`.
inline Motions motions_between(Simulation& simulation, double settled, double end) {
    run_for(simulation, settled - simulation.time());
    const std::vector<Vector> start = simulation.world().bodies.position;
    Motions motions;
    while (simulation.time() < end - 1e-9) {
        simulation.step();
        motions.fastest = std::max(motions.fastest, fastest_point(simulation.world()));
        motions.farthest = std::max(motions.farthest, farthest_from(start, simulation.world()));
    }
    return motions;
}

/// At rest nothing is faster than 0.1 mm/s, nor farther than 0.1 mm from where it was.
inline void expect_still(const Motions& motions) {
    EXPECT_LT(motions.fastest, 1e-4);
    EXPECT_LT(motions.farthest, 1e-4);
}

inline double total_energy(const Simulation& s) {
    return kinetic_energy(s.world()) + potential_energy(s.world());
}

/// For tests that run in each precision.
using InEachPrecision = testing::TestWithParam<Precision>;

inline auto each_precision() { return testing::Values(Precision::single, Precision::double_); }
inline std::string word_of(Precision precision) {
    return precision == Precision::single ? "single" : "double";
}
inline std::string precision_name(const testing::TestParamInfo<Precision>& info) {
    return word_of(info.param);
}

/// A collider and a precision.
using Where = std::tuple<std::string, Precision>;

class OnEveryCollider : public testing::TestWithParam<Where> {
protected:
    std::string collider() const { return std::get<0>(GetParam()); }
    /// An empty scene in the precision of the test.
    Scene scene() const {
        Scene s;
        s.settings.precision = std::get<1>(GetParam());
        return s;
    }
};

inline std::string where_name(const testing::TestParamInfo<Where>& info) {
    return std::get<0>(info.param) + "_" + word_of(std::get<1>(info.param));
}

inline auto every_collider() {
    return testing::Combine(testing::Values(std::string("reference"), std::string("ode"),
                                            std::string("bullet"), std::string("fcl")),
                            each_precision());
}

inline Scene ball_on_ground() {
    Scene s;
    add_ground(s);
    add_body(s, sphere(0.5), {0, 0.5, 0});
    return s;
}

}  // namespace plumb::test
