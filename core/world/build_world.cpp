// SPDX-License-Identifier: MIT
/// From what the user wrote to the tables of the world.
#include "scene/error.h"
#include "world/body_row.h"
#include "world/build_joints.h"
#include "world/build_links.h"
#include "world/build_particles.h"
#include "world/derived.h"
#include "world/world.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace plumb {
namespace {

void make_bodies(World& world, const Scene& scene) {
    resize_bodies(world.bodies, scene.bodies.size());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        BodyRow row = make_body(scene, scene.bodies[i], "/bodies/" + std::to_string(i));
        row.id = world.slots.add().id;
        put_body(world.bodies, i, row);
    }
}

void keep_apart(World& world, const Scene& scene) {
    for (std::size_t i = 0; i < scene.apart.size(); ++i) {
        const auto [low, high] = std::minmax(scene.apart[i][0], scene.apart[i][1]);
        if (high >= world.bodies.size() || low == high)
            throw SceneError("", "/apart/" + std::to_string(i), "must be two different bodies");
        world.excluded.push_back(pair_key(low, high));
    }
}

void check_air(const Settings& s) {
    const auto expect = [](bool good, const char* place, const char* sentence) {
        if (!good) throw SceneError("", place, sentence);
    };
    expect(!s.wind || s.wind->allFinite(), "/settings/wind", "must be finite numbers");
    expect(s.gusts.allFinite(), "/settings/gusts", "must be finite numbers");
    expect(s.gust_period > 0 && std::isfinite(s.gust_period), "/settings/gust_period",
           "must be a positive number of seconds");
    expect(s.air_density >= 0 && std::isfinite(s.air_density), "/settings/air_density",
           "must be finite and not negative");
}

}  // namespace

World build_world(const Scene& scene) {
    World world;
    world.settings = scene.settings;
    if (!(scene.settings.dt > 0) || !std::isfinite(scene.settings.dt))
        throw SceneError("", "/settings/dt", "the step must be a positive number of seconds");
    if (scene.settings.substeps == 0)
        throw SceneError("", "/settings/substeps", "at least one substep is needed");
    check_air(scene.settings);
    for (const Geometry& g : scene.geometries) world.shapes.add(g);
    make_bodies(world, scene);
    build_particles(world, scene);
    assign_rows(world);
    combine_surfaces(world, scene);
    keep_apart(world, scene);
    build_joints(world, scene);
    build_links(world, scene);
    return world;
}

}  // namespace plumb
