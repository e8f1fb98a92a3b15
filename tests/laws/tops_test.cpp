// SPDX-License-Identifier: MIT
/// Tops: on a plane, asleep above the critical spin; on joints, in steady precession.
#include "support/random.h"
#include "support/scenes.h"

#include <iostream>

namespace plumb::test {
namespace {

/// A top: a ball for a tip, at a distance below the centre of mass.
struct Top {
    double mass = 1, about_axis = 0.002, across = 0.003;  ///< [kg], [kg m²]
    double height = 0.08;                                 ///< of the centre above the tip's [m]
    double tip = 0.02;                                    ///< radius [m]
};

class Tops : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Tops, every_collider(), where_name);

/// Lean of the axis [degrees].
double lean_of(const World& w, std::size_t body, const Vector& axis_body) {
    const Vector up = w.bodies.orientation[body] * axis_body;
    return std::atan2(up.cross(Vector::UnitY()).norm(), up.y()) * 180 / std::numbers::pi;
}

/// Without friction, with α = θ exp(iφ) the lean: I₁ α'' − i I₃ ω α' − m g l α = 0. At s times the
/// critical spin 2 √(I₁ m g l) / I₃ a top that is let go leaning stays within s / √(s² − 1) of it.
TEST_P(Tops, SleepAboveTheCriticalSpin) {
    const Top top;
    const double share = 1.2, lean = 1;  // [degrees]
    const double spin =
        share * 2 * std::sqrt(top.across * top.mass * 9.81 * top.height) / top.about_axis;
    const double bound = lean * share / std::sqrt(share * share - 1);
    Random random(7);
    for (int setting = 0; setting < 4; ++setting) {
        Scene s = scene();
        if (setting > 0) use_fine_steps(s.settings);
        if (setting == 0) s.settings.dt = 0.002;
        if (setting == 2) s.settings.dt = 0.01, s.settings.substeps = 10;
        if (setting == 3)
            s.settings.dt = random.number(0.01, 0.02), s.settings.substeps = 10 + random.below(20);
        s.materials[0].friction = 0;
        add_ground(s);
        BodySpec& b = add_body(s, sphere(top.tip), {0, top.tip, 0});
        b.mass = top.mass;
        b.inertia = Vector(top.across, top.about_axis, top.across);
        b.mass_frame = Placement{{0, top.height, 0}, Rotation::Identity()};
        const Rotation tilt(Eigen::AngleAxisd(lean * std::numbers::pi / 180, Vector::UnitX()));
        b.placement.rotation = tilt;
        b.angular_velocity = tilt * Vector(0, spin, 0);
        Simulation simulation(s, colliders(), collider());
        const World& w = simulation.world();
        const Vector axis = w.bodies.orientation[1].conjugate() * (tilt * Vector::UnitY());
        double most = 0;
        const auto steps = std::llround(4 / w.settings.dt);
        for (long long i = 0; i < steps; ++i) {
            simulation.step();
            most = std::max(most, lean_of(w, 1, axis));
        }
        std::cout << w.settings.dt << " s x " << w.settings.substeps << ", spin " << spin
                  << " rad/s: leans to " << most << ", by the law " << bound << "\n";
        EXPECT_LT(most, 1.25 * bound) << "setting " << setting;
        EXPECT_GT(most, 0.8 * bound) << "setting " << setting;
    }
}

/// Degrees per second and radius by which a horizontal axis goes round in t seconds.
struct Round {
    double rate;    ///< mean [rad/s]
    double sagged;  ///< greatest departure from the level [rad]
};
Round precession(Simulation& simulation, std::size_t body, double seconds) {
    const World& w = simulation.world();
    double angle = 0, sagged = 0;
    Vector before = w.bodies.position[body];
    const auto steps = std::llround(seconds / w.settings.dt);
    for (long long i = 0; i < steps; ++i) {
        simulation.step();
        const Vector now = w.bodies.position[body];
        angle += std::atan2(before.z() * now.x() - before.x() * now.z(),
                            before.x() * now.x() + before.z() * now.z());
        sagged = std::max(sagged, std::abs(now.y()) / now.norm());
        before = now;
    }
    return {angle / (static_cast<double>(steps) * w.settings.dt), sagged};
}

/// A wheel that spins about a level axis, its pivot on a ball joint, or its hub on an arm that is.
/// Steady precession is exact here: Ω = m g l / (I_s ω_s).
struct Flywheel {
    double mass = 2, radius = 0.2, about_axis = 0.5 * mass * radius * radius,
           across = 0.6 * about_axis, length = 0.3;

    double law(double spin) const { return mass * 9.81 * length / (about_axis * spin); }

    Scene scene(const Settings& settings, double spin, bool on_arm) const {
        Scene s;
        s.settings = settings;
        const double rate = law(spin);
        BodySpec wheel;
        wheel.mass = mass;
        wheel.inertia = Vector(about_axis, across, across);
        wheel.placement.position = {length, 0, 0};
        wheel.velocity = Vector(0, rate, 0).cross(Vector(length, 0, 0));
        wheel.angular_velocity = {spin, rate, 0};
        s.bodies.push_back(wheel);
        JointSpec joint;
        joint.body_a = 0;
        if (on_arm) {
            BodySpec arm;
            arm.mass = 1e-3 * mass;
            arm.inertia = Vector::Constant(1e-3 * mass * length * length);
            arm.placement.position = {0, 0, 0};
            arm.angular_velocity = {0, rate, 0};
            s.bodies.push_back(arm);
            joint.kind = JointKind::hinge;
            joint.body_b = 1;
            joint.anchor = {length, 0, 0};
            s.joints.push_back(joint);
            joint = {};
            joint.body_a = 1;
        }
        joint.anchor = Vector::Zero();
        s.joints.push_back(joint);
        return s;
    }
};

/// A wheel in two gimbals: the outer one turns about the vertical, the inner one, that a load pulls
/// down at one side, about a level axis across the wheel's. Ω = m g l / (I_s ω_s).
struct Gimbals {
    double load = 0.5, length = 0.2;  ///< [kg], [m]
    double about_axis = 0.04;         ///< of the wheel [kg m²]

    double law(double spin) const { return load * 9.81 * length / (about_axis * spin); }

    Scene scene(const Settings& settings, double spin) const {
        Scene s;
        s.settings = settings;
        const Vector around(0, law(spin), 0);
        const auto add = [&](double mass, const Vector& inertia, const Vector& at) -> BodySpec& {
            BodySpec body;
            body.mass = mass;
            body.inertia = inertia;
            body.placement.position = at;
            body.angular_velocity = around;
            body.velocity = around.cross(at);
            return s.bodies.emplace_back(body);
        };
        add(0.2, Vector::Constant(0.004), Vector::Zero());
        add(load, Vector::Constant(0.003), {length, 0, 0});
        add(2, Vector(about_axis, 0.6 * about_axis, 0.6 * about_axis), Vector::Zero())
            .angular_velocity.x() = spin;
        const Vector axes[] = {Vector::UnitY(), Vector::UnitZ(), Vector::UnitX()};
        for (std::uint32_t i = 0; i < 3; ++i) {
            JointSpec joint;
            joint.kind = JointKind::hinge;
            joint.body_a = i;
            if (i > 0) joint.body_b = i - 1;
            joint.frame = rotation_between(Vector::UnitX(), axes[i]);
            s.joints.push_back(joint);
        }
        return s;
    }
};

/// A top whose axis leans, its tip on a ball joint. In steady precession, with A = I₁ + m l² and
/// the whole rate n about the axis, m g l = I₃ n Ω − A Ω² cos θ; the slower root is taken.
struct LeaningTop {
    double mass, about_axis, across, length, lean;  ///< [kg], [kg m²], [kg m²], [m], [rad]

    double pull() const { return mass * 9.81 * length; }
    double stiffness() const { return (across + mass * length * length) * std::cos(lean); }
    /// Twice the spin below which it cannot precess so.
    double slowest() const {
        return 4 * std::sqrt(std::max(0.0, pull() * stiffness())) / about_axis;
    }
    double law(double spin) const {
        const double l = about_axis * spin;
        return 2 * pull() / (l + std::sqrt(l * l - 4 * pull() * stiffness()));
    }

    Scene scene(const Settings& settings, double spin) const {
        Scene s;
        s.settings = settings;
        const Vector axis(std::sin(lean), std::cos(lean), 0);
        const double rate = law(spin);
        BodySpec& body = s.bodies.emplace_back();
        body.mass = mass;
        body.inertia = Vector(across, about_axis, across);
        body.placement = {length * axis, rotation_between(Vector::UnitY(), axis)};
        body.angular_velocity = rate * Vector::UnitY() + (spin - rate * std::cos(lean)) * axis;
        body.velocity = body.angular_velocity.cross(body.placement.position);
        JointSpec joint;
        joint.body_a = 0;
        joint.anchor = Vector::Zero();
        s.joints.push_back(joint);
        return s;
    }
};

LeaningTop drawn_top(Random& random) {
    LeaningTop top{};
    top.mass = std::exp(random.number(-3, 3));
    top.length = random.number(0.05, 0.3);
    const double square = top.mass * top.length * top.length;
    top.about_axis = square * random.number(0.3, 2);
    top.across = top.about_axis * random.number(0.55, 1.5);
    top.lean = random.number(20, 160) * std::numbers::pi / 180;
    return top;
}

/// Mean rate over its formula, of a body that is to go round in steady precession.
double share_of_law(const Scene& scene, std::size_t body, double law, const std::string& where) {
    Simulation simulation(scene, colliders(), "reference");
    const Round r = precession(simulation, body, 4);
    std::cout << where << ": precesses at " << r.rate / law << " of the law, sags by " << r.sagged
              << "\n";
    return r.rate / law;
}

/// 1/60 s with 20 substeps, then others of at most a millisecond.
Settings gyroscope_settings(int setting, Random& random) {
    Settings s;
    use_fine_steps(s);
    if (setting == 0) return s;
    s.dt = random.number(0.005, 0.02);
    s.substeps = static_cast<std::uint32_t>(std::ceil(s.dt / 0.001)) + random.below(10);
    s.precision = setting > 1 ? Precision::double_ : Precision::single;
    return s;
}

constexpr double kTurns[] = {0.1, 0.2, 0.5, 0.9, 1.0};  // [rad] a substep

std::string name_of(const std::string& on, const Settings& s, double turn) {
    return on + ", " + std::to_string(s.dt) + " s x " + std::to_string(s.substeps) + ", " +
           std::to_string(turn) + " rad a substep";
}

/// A lever that a joint holds and gravity pulls at asks for small substeps.
TEST(Gyroscope, PrecessesOnAJointAndOnAnArmByItsFormula) {
    const Flywheel wheel;
    Random random(8);
    for (int setting = 0; setting < 4; ++setting)
        for (const bool on_arm : {false, true})
            for (const double turn : kTurns) {
                const Settings s = gyroscope_settings(setting, random);
                const double spin = turn * s.substeps / s.dt;
                const std::string where = name_of(on_arm ? "arm" : "joint", s, turn);
                EXPECT_NEAR(share_of_law(wheel.scene(s, spin, on_arm), 0, wheel.law(spin), where),
                            1, 0.02)
                    << where;
            }
}

/// The arm of a top's joint lies along its spin, which swings nothing: such a top is as right at
/// 10 ms as at a millisecond.
TEST(Gyroscope, ALeaningTopPrecessesByItsFormula) {
    Random random(10);
    for (int draw = 0; draw < 60; ++draw) {
        Settings settings;
        if (draw % 3 == 1) use_fine_steps(settings);
        if (draw % 3 == 2) {
            settings.dt = random.number(0.002, 0.01);
            settings.substeps = 1 + random.below(10);
        }
        settings.precision = draw % 2 == 0 ? Precision::double_ : Precision::single;
        const double turn = random.number(0.2, 1);
        const double spin = turn * settings.substeps / settings.dt;
        LeaningTop top = drawn_top(random);
        while (top.slowest() > spin) top = drawn_top(random);
        Simulation simulation(top.scene(settings, spin), colliders(), "reference");
        const World& w = simulation.world();
        const Vector axis = w.bodies.orientation[0].conjugate() * w.bodies.position[0].normalized();
        const double share = precession(simulation, 0, 5).rate / top.law(spin);
        const double kept = w.bodies.angular_velocity[0].dot(w.bodies.orientation[0] * axis) / spin;
        SCOPED_TRACE(testing::Message()
                     << "draw " << draw << ", " << settings.dt << " s x " << settings.substeps
                     << ", " << turn << " rad a substep, leaning by " << top.lean << " rad");
        EXPECT_NEAR(share, 1, 0.005);
        EXPECT_NEAR(kept, 1, 1e-4);
    }
}

TEST(Gyroscope, PrecessesInGimbalsByItsFormula) {
    const Gimbals gimbals;
    Random random(9);
    for (int setting = -1; setting < 4; ++setting)
        for (const double turn : kTurns) {
            const Settings s = setting < 0 ? Settings{} : gyroscope_settings(setting, random);
            const double spin = turn * s.substeps / s.dt;
            const std::string where = name_of("gimbals", s, turn);
            if (setting < 0 && turn < 0.3) continue;  // goes round as fast as it spins
            EXPECT_NEAR(share_of_law(gimbals.scene(s, spin), 1, gimbals.law(spin), where), 1, 0.02)
                << where;
        }
}

}  // namespace
}  // namespace plumb::test
