// SPDX-License-Identifier: MIT
/// plumb check: validates a scene without running it.
#include "app/run_options.h"
#include "app/verbs.h"
#include "host/simulation.h"
#include "scene/deformable_faults.h"

#include <cstdio>
#include <memory>
#include <string>

namespace plumb::app {
namespace {

/// How meshes that move were cut into hulls.
void print_decomposed(const Scene& scene) {
    for (const Geometry& g : scene.geometries)
        if (g.concavity)
            std::printf(
                "  %s: a mesh as %zu convex hulls, whose surface lies up to %.3g m within\n",
                g.name.empty() ? "a shape without a name" : ("shape \"" + g.name + "\"").c_str(),
                g.parts.size(), *g.concavity);
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// What each deformable is made of.
void print_deformables(const Scene& scene) {
    for (const DeformableSpec& d : scene.deformables)
        std::printf("  %s \"%s\": %s, %s\n", name_of(d.kind), d.name.c_str(),
                    counted(d.points.size(), "point", "points").c_str(),
                    d.kind == DeformableKind::rope
                        ? counted(d.segments.size(), "segment", "segments").c_str()
                    : d.kind == DeformableKind::solid
                        ? counted(d.tetrahedra.size(), "tetrahedron", "tetrahedra").c_str()
                        : counted(d.triangles.size(), "triangle", "triangles").c_str());
}

int check(const RunOptions& options) {
    const Scene scene = load_scene(options);
    const ColliderLibrary colliders(options.plugin_path);
    const std::unique_ptr<Simulation> made = start(scene, colliders, options);
    const Simulation& simulation = *made;
    const World& world = simulation.world();
    std::printf(
        "%s: sound; %zu bodies (%d dynamic, %d kinematic), %zu joints, %zu particles, %zu shapes, "
        "%zu materials; collider %s\n",
        options.scene.c_str(), world.bodies.size(), world.dynamic_count, world.kinematic_count,
        scene.joints.size(), world.particles.size(), scene.geometries.size(),
        scene.materials.size(), simulation.collider_name().c_str());
    print_decomposed(scene);
    print_deformables(scene);
    return kDone;
}

}  // namespace

Verb add_check(CLI::App& command) {
    auto options = std::make_shared<RunOptions>();
    add_scene_options(command, *options);
    return [options] { return check(*options); };
}

}  // namespace plumb::app
