// SPDX-License-Identifier: MIT
/// Springs of every kind keep their swing for as long as substeps can follow it, and dampers take
/// from it what the formula says, at steps drawn at random.
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

namespace plumb::test {
namespace {

constexpr double kSpeed = 0.01;  // at first, so slow that sin φ = φ [m/s], [rad/s]
constexpr double kMass = 3, kInertia = kMass * 0.5 * 0.5 / 6;  // of a cube of 0.5 m [kg], [kg m²]

/// What pulls a cube back to where it was put.
struct SpringKind {
    const char* name;
    JointKind joint;
    std::uint32_t axis;
    bool compliant, motor;

    bool turns() const { return axis >= kTurnX; }
    double mass() const { return turns() ? kInertia : kMass; }
};
constexpr SpringKind kSpringKinds[] = {
    {"slider", JointKind::slider, kAlongX, false, false},
    {"hinge", JointKind::hinge, kTurnX, false, false},
    {"compliant_ball", JointKind::ball, kAlongX, true, false},
    {"compliant_fixed", JointKind::fixed, kTurnX, true, false},
    {"position_motor", JointKind::hinge, kTurnX, false, true},
};

using SpringCase = std::tuple<SpringKind, JointMethod, Precision>;

class Springs : public testing::TestWithParam<SpringCase> {
protected:
    SpringKind kind() const { return std::get<SpringKind>(GetParam()); }

    /// A cube that leaves its place along the axis, on a spring of frequency ω [rad/s] and
    /// damping ratio ζ.
    Scene scene(double omega, double zeta) const {
        const SpringKind k = kind();
        Scene s;
        s.settings.gravity.setZero();
        s.settings.leapfrog_start = true;
        s.settings.joints = std::get<JointMethod>(GetParam());
        s.settings.precision = std::get<Precision>(GetParam());
        BodySpec& cube = add_body(s, box(0.25, 0.25, 0.25), Vector::Zero());
        cube.mass = kMass;
        (k.turns() ? cube.angular_velocity : cube.velocity) = Vector(kSpeed, 0, 0);
        JointSpec& joint = add_joint(s, k.joint, 0, kNoIndex, Vector::Zero());
        const double stiffness = k.mass() * omega * omega, damping = 2 * zeta * k.mass() * omega;
        if (k.compliant) {
            (k.turns() ? joint.angular_compliance : joint.compliance) = 1 / stiffness;
        } else if (k.motor) {
            JointMotor& motor = joint.axes[k.axis].motor;
            motor.mode = MotorMode::position, motor.frequency = omega / (2 * std::numbers::pi);
            motor.damping_ratio = zeta, motor.greatest = 1e6;
        } else {
            joint.axes[k.axis].stiffness = stiffness, joint.axes[k.axis].damping = damping;
        }
        return s;
    }

    double place(const World& w) const {
        if (!kind().turns()) return w.bodies.position[0].x();
        const Rotation& q = w.bodies.orientation[0];
        return 2 * std::atan2(q.x(), q.w());
    }
};

std::string spring_case_name(const testing::TestParamInfo<SpringCase>& which) {
    const auto& [kind, joints, precision] = which.param;
    return std::string(kind.name) + "_" + (joints == JointMethod::tree ? "tree" : "iterated") +
           "_" + word_of(precision);
}
INSTANTIATE_TEST_SUITE_P(, Springs,
                         testing::Combine(testing::ValuesIn(kSpringKinds),
                                          testing::Values(JointMethod::tree, JointMethod::iterate),
                                          each_precision()),
                         spring_case_name);

/// Steps of 2 to 20 ms, 1 to 8 substeps and 1 to 20 iterations.
void draw_steps(Settings& s, Random& random) {
    s.dt = random.number(0.002, 0.02);
    s.substeps = 1 + random.below(8);
    s.velocity_iterations = s.position_iterations = 1 + random.below(20);
}

/// x(t) of a damped oscillator that leaves 0 at speed 1.
double oscillation(double omega, double zeta, double t) {
    const double decay = std::exp(-zeta * omega * t), wd2 = omega * omega * (1 - zeta * zeta);
    if (wd2 > 0) return decay * std::sin(std::sqrt(wd2) * t) / std::sqrt(wd2);
    return wd2 < 0 ? decay * std::sinh(std::sqrt(-wd2) * t) / std::sqrt(-wd2) : decay * t;
}

/// Up to a radian a substep a swing is as wide after a hundred periods as at first, and its period
/// is right to fourth order in h ω.
TEST_P(Springs, KeepTheirSwing) {
    Random random(7);
    for (int i = 0; i < 12; ++i) {
        Settings steps;
        draw_steps(steps, random);
        const double h = steps.dt / steps.substeps, angle = std::pow(random.number(0.3, 1), 2);
        Scene s = scene(angle / h, 0);
        s.settings.dt = h, s.settings.substeps = 1;  // each substep is seen
        s.settings.velocity_iterations = s.settings.position_iterations = steps.velocity_iterations;
        Simulation simulation(s, colliders(), "reference");
        const double period = 2 * std::numbers::pi / angle;  // in substeps
        double first = 0, last = 0, before = 0, crossed = 0;
        int crossings = 0;
        const int count = static_cast<int>(120 * period);
        for (int n = 1; n <= count; ++n) {
            simulation.step();
            const double x = place(simulation.world());
            double& widest = n < count / 2 ? first : last;
            widest = std::max(widest, std::abs(x));
            if (before < 0 && x >= 0) ++crossings, crossed = n - x / (x - before);
            before = x;
        }
        const double off = crossed / (crossings * period) - 1;
        EXPECT_NEAR(last / first, 1, 0.005) << "h ω " << angle;
        EXPECT_NEAR(off, 0, 1e-6 + std::pow(angle, 4) / 200 + std::pow(angle, 6) / 10)
            << "h ω " << angle;
    }
}

/// A swing of any damping follows its formula.
TEST_P(Springs, AreDampedByTheFormula) {
    if (kind().compliant) GTEST_SKIP() << "compliance has no damping";
    Random random(11);
    for (const double zeta : {0.02, 0.2, 0.7, 1.0, 2.0}) {
        Settings steps;
        draw_steps(steps, random);
        const double h = steps.dt / steps.substeps;
        const double angle = random.number(0.05, 0.3) / std::max(1.0, zeta), omega = angle / h;
        Scene s = scene(omega, zeta);
        s.settings.dt = steps.dt, s.settings.substeps = steps.substeps;
        s.settings.velocity_iterations = s.settings.position_iterations = steps.velocity_iterations;
        Simulation simulation(s, colliders(), "reference");
        double worst = 0;
        while (simulation.time() * omega < 20) {
            simulation.step();
            const double wanted = oscillation(omega, zeta, simulation.time());
            worst = std::max(worst, std::abs(place(simulation.world()) / kSpeed - wanted) * omega);
        }
        EXPECT_LT(worst, 1e-4 + 0.5 * angle * angle * (zeta + angle * angle))
            << "ζ " << zeta << ", h ω " << angle;
    }
}

/// Many springs on one body are as stable as one, however many and whatever their stiffness.
TEST_P(Springs, AreStableTogether) {
    for (const std::uint32_t count : {2u, 16u, 40u, 100u})
        for (const double angle : {0.2, 0.55, 0.77, 0.95}) {  // of each alone
            Scene s = scene(angle / 0.01, 0);
            s.settings.leapfrog_start = false;
            s.settings.dt = 0.01, s.settings.substeps = 1;
            const JointSpec one = s.joints[0];
            for (std::uint32_t i = 1; i < count; ++i) s.joints.push_back(one);
            Simulation simulation(s, colliders(), "reference");
            double farthest = 0;
            for (int i = 0; i < 1000; ++i) {
                simulation.step();
                farthest = std::max(farthest, std::abs(place(simulation.world())));
            }
            EXPECT_LT(farthest, 2 * kSpeed * 0.01 / angle) << count << " of " << angle;
        }
}

/// What no substep can follow dies away, as in the rigid joint that it stands for.
TEST_P(Springs, ComeToRestWhereTheyAreTooStiffToFollow) {
    for (const double angle : {2.5, 10.0, 1e3}) {
        Scene s = scene(angle / 0.01, 0);
        s.settings.dt = 0.01, s.settings.substeps = 1;
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, 1);
        EXPECT_LT(std::abs(place(simulation.world())), 1e-9 * kSpeed) << angle;
    }
}

/// Compliant ropes to all sides of a ball, of 55 rad/s each.
TEST(CompliantRopes, HoldABallFromAllSides) {
    Random random(3);
    for (const JointMethod method : {JointMethod::tree, JointMethod::iterate})
        for (const std::uint32_t count : {20u, 100u}) {
            Scene s;
            s.settings.gravity.setZero();
            s.settings.joints = method;
            BodySpec& ball = add_body(s, sphere(0.1), Vector::Zero());
            ball.mass = kMass, ball.velocity = Vector(kSpeed, 0, 0);
            for (std::uint32_t i = 0; i < count; ++i) {
                JointSpec& rope = add_joint(s, JointKind::distance, 0, kNoIndex, Vector::Zero());
                rope.anchor_b = Vector(random.direction());
                rope.compliance = 1.0 / 3000 / kMass;
            }
            Simulation simulation(s, colliders(), "reference");
            double fastest = 0;
            for (int i = 0; i < 500; ++i) {
                ASSERT_TRUE(simulation.step().finite);
                fastest = std::max(fastest, simulation.world().bodies.velocity[0].norm());
            }
            EXPECT_LT(fastest, 2 * kSpeed) << count;
        }
}

}  // namespace
}  // namespace plumb::test
