// SPDX-License-Identifier: MIT
/// What main.cpp asks of an engine. Each engine is a program of its own, since back-ends' global
/// symbols collide.
///
/// An engine is built from the scene and from Plumb's world of it: there bodies are at their centre
/// of mass along their principal axes, which is what every engine takes, and so is what is read
/// back.
#pragma once

#include "world/world.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace plumb::bench {

/// How finely an engine computes.
struct Fineness {
    double dt;       ///< [s]
    int iterations;  ///< of its solver; 0: it has none
};

/// Thrown by a step that an engine gives up.
struct EngineFailure {};

/// A scene on an engine.
class Peer {
public:
    virtual ~Peer() = default;
    virtual void step() = 0;
    /// Writes poses and velocities into the world that it was built from.
    virtual void read(World& world) = 0;
};

/// An engine, set up in one way.
struct Engine {
    std::string name;
    int iterations;  ///< its default; 0: it has none
    /// Why it cannot do a scene; "" where it can.
    std::function<std::string(const Scene&)> unable;
    std::function<std::unique_ptr<Peer>(const Scene&, const World&, const Fineness&)> make;
};

/// Those of this program.
std::vector<Engine> engines();

/// Turn from z, along which others lay planes and cylinders, to y, along which Plumb does.
inline Quaterniond z_to_y() {
    return Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d::UnitY());
}

inline bool collides(const Scene& scene) {
    const auto& forbidden = scene.settings.forbid;
    return std::find(forbidden.begin(), forbidden.end(), "contacts") == forbidden.end();
}

inline bool is_dynamic(const World& world, std::size_t body) {
    return world.bodies.motion[body] == Motion::dynamic;
}

/// Whether bodies are joined, so that they do not collide.
inline bool is_excluded(const World& world, std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = pair_key(std::min(a, b), std::max(a, b));
    return std::binary_search(world.excluded.begin(), world.excluded.end(), key);
}

/// Whether all joints are of the kinds of a list.
inline bool joints_are(const Scene& scene, std::initializer_list<JointKind> kinds) {
    return std::all_of(scene.joints.begin(), scene.joints.end(), [&](const JointSpec& joint) {
        return std::find(kinds.begin(), kinds.end(), joint.kind) != kinds.end();
    });
}

/// Why an engine with these round shapes beside planes and boxes does not do a scene; "" where it
/// does.
inline std::string other_shapes(const Scene& scene, std::initializer_list<ShapeKind> round) {
    for (const Geometry& g : scene.geometries) {
        if (g.kind == ShapeKind::plane || g.kind == ShapeKind::box) continue;
        if (std::find(round.begin(), round.end(), g.kind) == round.end())
            return "shapes of kind " + std::string(name_of(g.kind)) + " are not passed on";
    }
    return "";
}

}  // namespace plumb::bench
