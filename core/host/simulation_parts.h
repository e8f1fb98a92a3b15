// SPDX-License-Identifier: MIT
/// What a Simulation is made of. Private to it.
#pragma once

#include "host/add_bodies.h"
#include "host/contact_record.h"
#include "host/simulation.h"
#include "step/step.h"

#include <map>
#include <optional>
#include <string>

namespace plumb {

/// Identifiers by name, those of one name in the order in which they came. What was removed stays.
using Names = std::multimap<std::string, std::uint32_t>;

/// Throws std::invalid_argument for numbers that place nothing.
void expect_placement(const Placement& placement);

struct Simulation::Parts {
    class Guest;

    Scene assets;  ///< the scene's geometries, materials and remarks, without its bodies and joints
    World world;
    Stepper stepper;
    ProximityPtr owned;
    Proximity& proximity;
    std::optional<ColliderLibrary> library;  ///< where the collider is one of its plugins
    std::string collider_name, collider_version, collider_reason;
    bool filled = false;                  ///< the collider has the bodies
    bool placed = false;                  ///< and knows where they are now
    bool outdated = false;                ///< the stepper is of the world before an edit
    std::vector<std::uint8_t> broken;     ///< [joint] whether it was, when the stepper was made
    std::optional<ContactRecord> record;  ///< where contacts are watched
    DetectStats stats{};                  ///< of the last step
    FrameResidual residual;               ///< of the last step, where there was one
    Names body_names, joint_names;
    std::vector<std::string> told;  ///< warnings of the plan that were logged

    Parts(const Scene& scene, ProximityPtr plugin, Proximity& p, std::string name,
          std::string version);

    /// Brings the stepper up to date with the edits made.
    void renew();

    /// Logs the warnings of the plan that were not logged before.
    void tell_warnings();
    /// Logs what went wrong in a step.
    void tell_step(const StepReport& report) const;

    /// Once the stepper is of the world as it is now.
    void note_broken_joints();

    /// Makes the stepper as it was made when these joints were broken [joint], with nothing of what
    /// it has done since.
    void renew_at(const std::vector<std::uint8_t>& broken_then);

    /// Replaces World::excluded, and tells the collider. Throws ColliderError where it refuses, and
    /// then leaves all as it was.
    void exclude_only(std::vector<std::uint64_t> keys);

    /// The slot of a body in its table; the index of a joint or a coupling in its. Throw
    /// std::out_of_range where there is none.
    std::uint32_t slot(std::uint32_t body) const;
    std::uint32_t joint_index(std::uint32_t joint) const;
    std::uint32_t coupling_index(std::uint32_t coupling) const;
    const Joint& joint(std::uint32_t id) const { return world.joints.joints[joint_index(id)]; }

    /// The collider, for questions at the poses of now: it is told them once after each change.
    Proximity& at_poses_of_now();

    /// Throws unless the collider answered a question.
    void expect_answer(const Status& status, const std::string& question) const;

    /// Throws ColliderError where the plugin lacks a pair of shapes that the new body brings.
    void check_pairs(const BodyRow& row, const std::string& name);

    /// Wakes what touches a body or is near it, and the body itself.
    void wake_near(std::uint32_t slot);
    void wake_joined_by(std::uint32_t joint);  ///< by its index

    /// Hands a body that was just inserted to the collider, with all others where it has none yet
    /// and now needs them.
    void hand_over(std::uint32_t slot, const BodyRow& row);
};

}  // namespace plumb
