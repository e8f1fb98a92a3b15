// SPDX-License-Identifier: MIT
/// A box and a ball fall on the ground: hello [COLLIDER]
#include "host/simulation.h"

#include <cstdio>
#include <exception>

namespace {

/// Adds a body of a shape at a height [m] and a place beside the origin [m].
void add(plumb::Scene& scene, const plumb::Geometry& shape, double x, double height,
         plumb::Motion motion) {
    scene.geometries.push_back(shape);
    plumb::BodySpec body;
    body.geometry = static_cast<std::uint32_t>(scene.geometries.size()) - 1;
    body.placement.position = {x, height, 0};
    body.motion = motion;
    scene.bodies.push_back(body);
}

}  // namespace

int main(int argc, char** argv) try {
    plumb::Geometry ground, box, ball;
    ground.kind = plumb::ShapeKind::plane;
    box.kind = plumb::ShapeKind::box;
    box.half_extents = {0.5, 0.25, 0.5};
    ball.kind = plumb::ShapeKind::sphere;
    ball.radius = 0.3;

    plumb::Scene scene;
    add(scene, ground, 0, 0, plumb::Motion::fixed);
    add(scene, box, -1, 2, plumb::Motion::dynamic);
    add(scene, ball, 1, 2, plumb::Motion::dynamic);

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
