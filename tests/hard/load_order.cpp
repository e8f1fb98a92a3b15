// SPDX-License-Identifier: MIT
/// load_order NAME…: loads colliders in the order of the names, runs a small scene on each in that
/// order, and prints "NAME HASH" for each, sorted by name. What the hashes are must not depend on
/// the order.
#include "host/simulation.h"
#include "measure/measure.h"

#include <cstdio>
#include <filesystem>
#include <map>

namespace {

using namespace plumb;
namespace fs = std::filesystem;

Geometry geometry(ShapeKind kind, double size) {
    Geometry g;
    g.kind = kind;
    g.half_extents = {size, 0.7 * size, 0.9 * size};
    g.radius = 0.5 * size, g.half_height = size;
    return g;
}

/// Boxes, balls and capsules that tumble onto each other on a plane.
Scene heap() {
    Scene scene;
    scene.geometries = {geometry(ShapeKind::plane, 1), geometry(ShapeKind::box, 0.3),
                        geometry(ShapeKind::sphere, 0.5), geometry(ShapeKind::capsule, 0.3)};
    for (std::uint32_t i = 0; i < 25; ++i) {
        BodySpec body;
        body.geometry = i == 0 ? 0 : 1 + i % 3;
        body.motion = i == 0 ? Motion::fixed : Motion::dynamic;
        if (i > 0) body.placement.position = {0.2 * (i % 5), 0.4 + 0.3 * i, 0.1 * (i % 7)};
        scene.bodies.push_back(body);
    }
    return scene;
}

/// A folder for each plugin, so that the search path decides the order of loading.
std::string search_path(int count, char** names, const fs::path& folder) {
    std::string path;
    for (int i = 0; i < count; ++i) {
        const fs::path own = folder / std::to_string(i);
        std::string file = "plumb_collider_";
        file.append(names[i]).append(".so");
        fs::create_directories(own);
        fs::create_symlink(fs::path(PLUMB_TEST_PLUGINS) / file, own / file);
        if (i > 0) path.append(":");
        path.append(own.string());
    }
    return path;
}

std::uint64_t hash_of_run(const ColliderLibrary& library, const char* name) {
    Simulation simulation(heap(), library, name);
    for (int i = 0; i < 150; ++i) simulation.step();
    return state_hash(simulation.world());
}

}  // namespace

int main(int count, char** words) {
    std::string pattern = fs::temp_directory_path() / "load_order_XXXXXX";
    const fs::path folder = mkdtemp(pattern.data());
    const ColliderLibrary library(search_path(count - 1, words + 1, folder));
    std::map<std::string, std::uint64_t> hashes;
    for (int i = 1; i < count; ++i) {
        if (library.all().at(static_cast<std::size_t>(i) - 1).name != words[i]) return 1;
        hashes[words[i]] = hash_of_run(library, words[i]);
    }
    for (const auto& [name, hash] : hashes)
        std::printf("%s %016llx\n", name.c_str(), static_cast<unsigned long long>(hash));
    fs::remove_all(folder);
}
