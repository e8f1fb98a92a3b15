// SPDX-License-Identifier: MIT
/// A body that hangs by two points swings like a pendulum: friction holds a point, and takes
/// nothing from what turns about it. Only friction of turning brings it to rest.
#include "support/scenes.h"

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

double tilt_of_plank(const World& world) {
    const Vector up = world.bodies.orientation[2] * Vector::UnitY();
    return std::atan2(-up.x(), up.y());
}

struct Swinging {
    double period = 0, widest = 0;  ///< [s], [rad]
};

Swinging swing_for(Simulation& simulation, double seconds) {
    Swinging s;
    double before = tilt_of_plank(simulation.world()), first = 0;
    int upwards = 0;
    for (const double end = simulation.time() + seconds; simulation.time() < end;) {
        simulation.step();
        const double now = tilt_of_plank(simulation.world());
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

/// For a minute. Contacts take some of the swing, in proportion to the substep, and add nothing: in
/// ten seconds at 0.8 ms no more than 3 %.
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
            EXPECT_GT(now.widest, 0.97 * widest);
            widest = now.widest;
        }
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
