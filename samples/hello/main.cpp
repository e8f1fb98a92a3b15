// SPDX-License-Identifier: MIT
/// A box and a ball fall on the ground: hello [COLLIDER]
#include "host/simulation.h"
#include "scene/build.h"

#include <cstdio>
#include <exception>

int main(int argc, char** argv) try {
    plumb::Scene scene;
    plumb::add_ground(scene);
    plumb::add_body(scene, plumb::box(0.5, 0.25, 0.5), {-1, 2, 0});
    plumb::add_body(scene, plumb::sphere(0.3), {1, 2, 0});

    const plumb::ColliderLibrary colliders(PLUGIN_DIRECTORY);
    plumb::Simulation simulation(scene, colliders, argc > 1 ? argv[1] : "auto");
    while (simulation.time() < 3) simulation.step();

    plumb::Frame frame;
    simulation.capture(frame);
    std::printf("%s: after %.0f s the box rests at %.4f m and the ball at %.4f m\n",
                simulation.collider_name().c_str(), simulation.time(),
                frame.bodies[1].placement.position.y(), frame.bodies[2].placement.position.y());
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "hello: %s\n", error.what());
    return 1;
}
