// SPDX-License-Identifier: MIT
/// What a scene calls for, and why: the plan of a run.
///
/// An effect that is not called for costs no call, no allocation and no memory. The plan says what
/// may run; a step still skips what nothing moves, such as joints' iterations in a world without
/// contacts.
#pragma once

#include "world/world.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

enum class Effect : std::uint32_t {
    contacts,
    contact_reuse,
    friction,
    turning_friction,
    restitution,
    impacts,
    sticking_anchors,
    rims,
    still_ground,
    gyroscopic,
    exact_islands,
    joints,
    joint_trees,
    divided_trees,
    deformables,
    exact_deformables,
    air_drag,
    tearing,
    links,
    particle_contacts,
    surface_contacts,
    kinematics,
    sleeping,
    shock_propagation,
};
inline constexpr std::size_t kEffectCount = 24;

struct Decision {
    std::string_view name;
    bool runs = false;
    std::string why;
};

struct Plan {
    std::array<Decision, kEffectCount> decisions;
    std::vector<std::string> warnings;  ///< an effect that is needed but
                                        ///< forbidden, and the remarks of the scene's reader

    bool runs(Effect e) const { return decisions[static_cast<std::size_t>(e)].runs; }

    /// Whether the same effects run as by another plan.
    bool runs_as(const Plan& other) const {
        return std::equal(decisions.begin(), decisions.end(), other.decisions.begin(),
                          [](const Decision& p, const Decision& q) { return p.runs == q.runs; });
    }
};

/// Asks every effect whether the world wants it, and applies Settings::require and
/// Settings::forbid. Throws SceneError for an effect that does not exist.
Plan make_plan(const World& world);

}  // namespace plumb
