// SPDX-License-Identifier: MIT
/// Whoever answers which contacts there are at given poses: a collider of this process, or one in
/// another (remote_source.h).
#pragma once

#include "contacts/contact_room.h"
#include "host/collider_library.h"
#include "world/world.h"

#include <cstdint>
#include <string>
#include <vector>

namespace plumb {

/// What is known of the collider behind a source.
struct SourceInfo {
    std::string name, version, precision;
};

/// One question, without filter or history: every collider is asked the same.
struct ContactQuestion {
    const std::vector<Pose>& poses;  ///< [body]
    double margin;                   ///< [m]
    bool raw;                        ///< what the back-end itself says
    const double* sweeps = nullptr;  ///< [body] as in DetectRequest [m], or none
};

struct ContactAnswer {
    std::vector<Contact> contacts;  ///< sorted by (a, b), all finite and of bodies that exist
    DetectStats stats{};
    double seconds = 0;          ///< inside the collider's call
    std::uint32_t rejected = 0;  ///< contacts left out: not finite, or of no body
    std::string trouble;  ///< what the collider said when it failed on a part; empty: all is well
};

class ContactSource {
public:
    virtual ~ContactSource() = default;
    virtual const SourceInfo& info() const = 0;

    /// Throws ColliderError when there will be no more answers.
    virtual ContactAnswer ask(const ContactQuestion& question) = 0;
};

/// Poses of all bodies, as a question holds them.
void take_poses(std::vector<Pose>& poses, const World& world);

/// A plugin of this process, with the bodies of a scene and nothing else in it.
class LocalSource final : public ContactSource {
public:
    /// Throws ColliderError where the plugin is missing or lacks what the scene needs, SceneError
    /// where the scene makes no world.
    LocalSource(const Scene& scene, const ColliderLibrary& colliders, const std::string& name);

    const SourceInfo& info() const override { return info_; }
    ContactAnswer ask(const ContactQuestion& question) override;
    const World& world() const { return world_; }  ///< shapes and local frames; it never moves

private:
    World world_;
    ProximityPtr collider_;
    ContactRoom room_;
    SourceInfo info_;
};

}  // namespace plumb
