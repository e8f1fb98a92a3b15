// SPDX-License-Identifier: MIT
/// A body that hangs by two points, or rolls to and fro about where it is lowest, swings like a
/// pendulum: friction holds a point, and takes nothing from what turns about it. Only friction of
/// turning brings it to rest.
#include "support/random.h"
#include "support/scenes.h"

#include <functional>

namespace plumb::test {
namespace {

/// A plank that lies on two fixed balls, with its centre of mass below them.
struct KnifeEdge {
    double radius = 0.001;  ///< of the balls [m]
    double depth = 0.2;     ///< of the centre of mass below the plank's lower face [m]
    double mass = 2;        ///< [kg]
    double inertia = 0.02;  ///< about the line through the balls [kg m²]
    double angle = 0.05;    ///< at the start [rad]

    /// A plane that rolls on a cylinder has the potential energy m g (d + r) θ²/2 [s].
    double period() const {
        return 2 * std::numbers::pi *
               std::sqrt((inertia + mass * depth * depth) / (mass * 9.81 * (depth + radius)));
    }

    void add_to(Scene& s) const {
        for (const double z : {-0.3, 0.3})
            add_body(s, sphere(radius), {0, 0, z}).motion = Motion::fixed;
        constexpr double kHalfThick = 0.01;
        const Rotation turn(Eigen::AngleAxisd(angle, Vector::UnitZ()));
        const Vector out = turn * Vector::UnitY(), along = turn * Vector::UnitX();
        BodySpec& plank = add_body(s, box(0.05, kHalfThick, 0.4),
                                   (radius + kHalfThick) * out - radius * angle * along);
        plank.placement.rotation = turn;
        plank.mass = mass;
        plank.inertia = Vector::Constant(inertia);
        plank.mass_frame = Placement{};
        plank.mass_frame->position = {0, -kHalfThick - depth, 0};
    }
};

/// Of the body that was added last, about z [rad]; `upright`: its orientation at 0.
double tilt_of_last(const World& world, const Rotation& upright) {
    const Vector up = world.bodies.orientation.back() * (upright.conjugate() * Vector::UnitY());
    return std::atan2(-up.x(), up.y());
}

struct Swinging {
    double period = 0, widest = 0;  ///< [s], [rad]
};

Swinging swing_for(Simulation& simulation, double seconds,
                   const Rotation& upright = Rotation::Identity()) {
    Swinging s;
    double before = tilt_of_last(simulation.world(), upright), first = 0;
    int upwards = 0;
    for (const double end = simulation.time() + seconds; simulation.time() < end;) {
        simulation.step();
        const double now = tilt_of_last(simulation.world(), upright);
        if (before < 0 && now >= 0) {
            const double at =
                simulation.time() - simulation.world().settings.dt * now / (now - before);
            if (++upwards == 1)
                first = at;
            else
                s.period = (at - first) / (upwards - 1);
        }
        s.widest = std::max(s.widest, std::abs(now));
        before = now;
    }
    return s;
}

class KnifeEdges : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, KnifeEdges, every_collider(), where_name);

/// For a minute, in each ten seconds of which no more than a thousandth is lost.
TEST_P(KnifeEdges, SwingLikePendulums) {
    for (const double depth : {0.1, 0.2, 0.5}) {
        SCOPED_TRACE(depth);
        Scene s = scene();
        s.materials[0].friction = 1;
        use_fine_steps(s.settings);
        KnifeEdge edge;
        edge.depth = depth;
        edge.add_to(s);
        Simulation simulation(s, colliders(), collider());
        double widest = edge.angle;
        for (int sixth = 0; sixth < 6; ++sixth) {
            const Swinging now = swing_for(simulation, 10);
            EXPECT_NEAR(now.period, edge.period(), 5e-4 * edge.period());
            EXPECT_LT(now.widest, 1.001 * widest);
            EXPECT_GT(now.widest, 0.999 * widest);
            widest = now.widest;
        }
    }
}

/// A body that swings on fixed ground in a plane: by its height and by how far its centre of mass
/// is from where it touches, at an angle.
struct Rocker {
    double mass = 2, inertia = 0.02;        ///< [kg], about the centre of mass along z [kg m²]
    std::function<double(double)> height;   ///< of the centre of mass [m]
    std::function<double(double)> squared;  ///< distance from where it touches, squared [m²]
    Rotation upright = Rotation::Identity();

    /// Of a swing to and fro from an angle [s]: the integral of dθ/θ' by energy, θ = θ₀ sin φ.
    double period(double angle) const {
        constexpr int kParts = 200;
        double sum = 0;
        for (int i = 0; i < kParts; ++i) {
            const double phi = (i + 0.5) / kParts * std::numbers::pi / 2,
                         at = angle * std::sin(phi);
            const double squared_rate =
                2 * mass * 9.81 * (height(angle) - height(at)) / (inertia + mass * squared(at));
            sum += angle * std::cos(phi) / std::sqrt(squared_rate);
        }
        return 4 * sum * std::numbers::pi / 2 / kParts;
    }
};

/// A ball or a capsule on the ground, with its centre of mass below the middle.
Rocker add_round(Scene& s, const Geometry& shape, double radius, double below, double angle) {
    add_ground(s);
    const Rotation turn(Eigen::AngleAxisd(angle, Vector::UnitZ()));
    const Rocker rocker{.height = [=](double a) { return radius - below * std::cos(a); },
                        .squared =
                            [=](double a) {
                                return radius * radius + below * below -
                                       2 * radius * below * std::cos(a);
                            },
                        .upright = shape.kind == ShapeKind::capsule
                                       ? rotation_between(Vector::UnitY(), Vector::UnitZ())
                                       : Rotation::Identity()};
    BodySpec& body = add_body(s, shape, {0, radius, 0});
    body.placement.rotation = turn * rocker.upright;
    body.mass = rocker.mass;
    body.inertia = Vector::Constant(rocker.inertia);
    body.mass_frame = Placement{};
    body.mass_frame->position = rocker.upright.conjugate() * Vector(0, -below, 0);
    return rocker;
}

/// A plank that rolls on two balls.
Rocker add_plank(Scene& s, double radius, double depth, double angle) {
    KnifeEdge edge;
    edge.radius = radius, edge.depth = depth, edge.angle = angle;
    edge.add_to(s);
    return {.height =
                [=](double a) { return (radius - depth) * std::cos(a) + radius * a * std::sin(a); },
            .squared = [=](double a) { return depth * depth + radius * radius * a * a; }};
}

/// Substeps of at most 2 ms, however the steps are divided and iterated.
void draw_settings(Settings& s, Random& random) {
    s.substeps = 1 + random.below(20);
    s.dt = std::min(random.number(2e-4, 2e-3) * s.substeps, 0.02);
    s.velocity_iterations = s.position_iterations = 1 + random.below(10);
}

/// For a minute, of which no more than five thousandths are lost.
TEST_P(KnifeEdges, AndWhatRollsSwingWhateverTheSettings) {
    Random random(5);
    for (int draw = 0; draw < 8; ++draw) {
        Scene s = scene();
        s.materials[0].friction = 1;
        draw_settings(s.settings, random);
        const double angle = random.number(0.1, 0.4), below = random.number(0.05, 0.12);
        const double radius = random.number(0.15, 0.3);
        const bool capsules = collider() != "reference";
        const Rocker rocker =
            draw % 4 < 2    ? add_plank(s, random.number(5e-4, 2e-3), below + 0.1, angle)
            : draw % 4 == 2 ? add_round(s, sphere(radius), radius, below, angle)
                            : add_round(s, capsules ? capsule(radius, 0.2) : sphere(radius), radius,
                                        below, angle);
        SCOPED_TRACE(testing::Message()
                     << "draw " << draw << ", " << s.settings.dt << " s x " << s.settings.substeps
                     << ", " << s.settings.velocity_iterations << " iterations, " << angle
                     << " rad");
        Simulation simulation(s, colliders(), collider());
        const double exact = rocker.period(angle);
        EXPECT_NEAR(swing_for(simulation, 8 * exact, rocker.upright).period, exact, 2e-3 * exact);
        run_for(simulation, 60 - simulation.time());
        const double left = swing_for(simulation, exact, rocker.upright).widest;
        EXPECT_LT(left, 1.001 * angle);
        EXPECT_GT(left, 0.995 * angle);
    }
}

/// A lever ρ takes ρ N from each radian that it turns: 2 ρ/(d + r) from the angle of each half of a
/// swing, until it stands.
TEST_P(KnifeEdges, StopWhereTurningIsResisted) {
    for (const double lever : {1e-4, 2e-4, 3e-4}) {
        SCOPED_TRACE(lever);
        Scene s = scene();
        s.materials[0].friction = 1;
        s.materials[0].rolling_friction = lever;
        use_fine_steps(s.settings);
        const KnifeEdge edge;
        edge.add_to(s);
        Simulation simulation(s, colliders(), collider());
        const double loss = 2 * lever / (edge.depth + edge.radius);
        for (int k = 0; 2 * k * loss < edge.angle; ++k)
            EXPECT_NEAR(swing_for(simulation, edge.period()).widest, edge.angle - 2 * k * loss,
                        0.08 * edge.angle)
                << k;
        run_for(simulation, 2 * edge.period());
        EXPECT_LT(fastest_point(simulation.world()), 1e-4);
    }
}

}  // namespace
}  // namespace plumb::test
