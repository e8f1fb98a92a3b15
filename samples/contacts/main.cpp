// SPDX-License-Identifier: MIT
/// A ball falls on a scale: contacts COLLIDER [STATE]
///
/// Told are the knocks, and what the scale bears once all is at rest. On the way the state is
/// written to a file, contacts.state; given to another process, it goes on from there to the very
/// same numbers. The exit code tells whether the scale is right.
#include "host/simulation.h"
#include "scene/build.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>

namespace {

plumb::Scene scale() {
    plumb::Scene scene;
    scene.settings.substeps = 10;
    scene.materials[0].restitution = 0.4;
    plumb::add_ground(scene);
    plumb::add_body(scene, plumb::box(0.4, 0.05, 0.4), {0, 0.05, 0}).name = "scale";
    plumb::BodySpec& ball = plumb::add_body(scene, plumb::sphere(0.1), {0.1, 3, 0});
    ball.name = "ball", ball.mass = 2;
    return scene;
}

/// Mean force in the last step that a body bears downwards [N].
double load_on(const plumb::Simulation& simulation, std::uint32_t body) {
    double load = 0;
    for (const plumb::BodyContact& c : simulation.contacts()) {
        const double up = c.force().y();  // on a, and the opposite on b
        if (c.body_a == body && up < 0) load -= up;
        if (c.body_b == body && up > 0) load += up;
    }
    return load;
}

void run(plumb::Simulation& simulation, double until) {
    simulation.watch_contacts({.least_speed = 1});
    while (simulation.time() < until) {
        simulation.step();
        for (const plumb::ContactEvent& event : simulation.contact_events())
            if (event.kind == plumb::ContactEvent::Kind::hit)
                std::printf("%.2f s: bodies %u and %u meet at %.2f m/s, %.2f N s\n",
                            simulation.time(), event.body_a, event.body_b, event.approach_speed,
                            event.impulse);
    }
}

}  // namespace

int main(int argc, char** argv) try {
    const plumb::ColliderLibrary colliders(PLUGIN_DIRECTORY);
    plumb::Simulation simulation(scale(), colliders, argc > 1 ? argv[1] : "auto");
    if (argc > 2) {
        std::ifstream file(argv[2], std::ios::binary);
        simulation.restore(std::string(std::istreambuf_iterator<char>(file), {}));
    } else {
        run(simulation, 1);
        std::ofstream("contacts.state", std::ios::binary) << simulation.save();
    }
    run(simulation, 6);
    const double load = load_on(simulation, *simulation.find_body("scale"));
    std::printf("the ball weighs %.17g N\n", load);
    return std::abs(load - 2 * 9.81) < 0.001 ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "contacts: %s\n", error.what());
    return 1;
}
