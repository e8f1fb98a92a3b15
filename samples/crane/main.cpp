// SPDX-License-Identifier: MIT
/// A crane that makes its chain while it runs: crane [COLLIDER]
///
/// Link by link a chain grows down from a trolley, and a load is hung under it. Once all is still,
/// the trolley drives off, the load is let go in full swing by taking its joint away, and the chain
/// is hauled in. What the hook bears and how the load flies is held against formulas; the exit code
/// tells whether they agree.
#include "host/simulation.h"
#include "scene/build.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

namespace {

using Vector = Eigen::Vector3d;

constexpr double kHalfLink = 0.2;                // [m]
constexpr double kLinkMass = 2, kLoadMass = 50;  // [kg]
constexpr double kG = 9.81;                      // [m/s²]

void run(plumb::Simulation& simulation, double seconds) {
    const double end = simulation.time() + seconds - 1e-9;
    while (simulation.time() < end) simulation.step();
}

/// A body of a shape and mass that hangs by a ball joint at its upper end.
struct Hung {
    std::uint32_t body, joint;
};

/// Hangs a body, straight down from a point [m] of another one.
Hung hang(plumb::Simulation& simulation, std::uint32_t geometry, double mass, double half_height,
          std::uint32_t above, const Vector& point) {
    plumb::BodySpec body;
    body.geometry = geometry;
    body.mass = mass;
    body.placement.position = point - Vector(0, half_height, 0);
    plumb::JointSpec joint;
    joint.body_a = simulation.add_body(body);
    joint.body_b = above;
    joint.anchor = point;
    return {joint.body_a, simulation.add_joint(joint)};
}

bool agree(const char* what, double is, double should_be, double tolerance) {
    std::printf("%s: %.3f, by the formula %.3f\n", what, is, should_be);
    return std::abs(is - should_be) <= tolerance;
}

}  // namespace

int main(int argc, char** argv) try {
    plumb::Scene scene;
    plumb::add_ground(scene);
    plumb::BodySpec trolley;
    trolley.motion = plumb::Motion::kinematic;
    trolley.placement.position = {0, 8, 0};
    scene.bodies.push_back(trolley);
    const std::uint32_t link = add_geometry(scene, plumb::capsule(0.05, kHalfLink - 0.05));
    const std::uint32_t box = add_geometry(scene, plumb::box(0.3, 0.3, 0.3));

    const plumb::ColliderLibrary colliders(PLUGIN_DIRECTORY);
    plumb::Simulation simulation(scene, colliders, argc > 1 ? argv[1] : "ode");

    std::vector<Hung> chain;
    Vector end = trolley.placement.position;
    std::uint32_t last = 1;  // the trolley
    for (int i = 0; i < 8; ++i, end.y() -= 2 * kHalfLink) {
        chain.push_back(hang(simulation, link, kLinkMass, kHalfLink, last, end));
        last = chain.back().body;
        run(simulation, 0.2);
    }
    const Hung load = hang(simulation, box, kLoadMass, 0.3, last, end);
    run(simulation, 2);
    bool good = agree("the hook bears [N]", simulation.joint_load(chain[0].joint).force.y(),
                      (8 * kLinkMass + kLoadMass) * kG, 0.1);

    simulation.set_velocity(1, {2, 0, 0}, Vector::Zero());
    run(simulation, 1.5);
    simulation.set_velocity(1, Vector::Zero(), Vector::Zero());
    run(simulation, 0.2);
    simulation.remove_joint(load.joint);
    const plumb::BodyState start = simulation.body_state(load.body);
    const double t = 0.4, h = simulation.world().settings.dt;
    run(simulation, t);
    const plumb::BodyState now = simulation.body_state(load.body);
    const Vector flown = now.placement.position - start.placement.position;
    good &= agree("the load flew [m]", flown.x(), t * start.velocity.x(), 1e-9);
    good &= agree("and fell [m]", flown.y(), t * start.velocity.y() - kG * t * (t + h) / 2, 1e-9);

    while (!chain.empty()) {
        simulation.remove_body(chain.back().body);
        chain.pop_back();
        run(simulation, 0.2);
    }
    run(simulation, 3);
    good &= agree("it came to rest at a height [m]",
                  simulation.body_state(load.body).placement.position.y(), 0.3, 1e-3);
    good &= !simulation.has_joint(load.joint);
    return good ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "crane: %s\n", error.what());
    return 1;
}
