// SPDX-License-Identifier: MIT
/// Collision plugins: finding, loading and refusing them.
#pragma once

#include <plumb/plugin.h>

#include "host/choose_collider.h"
#include "host/load_plugin.h"
#include "scene/scene.h"

#include <memory>
#include <string>
#include <vector>

namespace plumb {

struct ProximityDeleter {
    void (*destroy)(Proximity*) = nullptr;
    void operator()(Proximity* p) const {
        if (p && destroy) destroy(p);
    }
};
using ProximityPtr = std::unique_ptr<Proximity, ProximityDeleter>;

/// All plugins of the search path: `extra_path` (directories separated by ':'), then
/// PLUMB_PLUGIN_PATH, then plumb/plugins beside the library or the program. A file that cannot be
/// loaded stays listed with its reason and is never fatal to the others. Of two files of one name
/// the first counts; of two files whose tables have one name the second is refused. Plugins stay
/// loaded until the process ends.
class ColliderLibrary {
public:
    /// `only`, where given, is the one plugin that is opened, by its file's name: for a process
    /// that must not even load the others.
    explicit ColliderLibrary(const std::string& extra_path = {}, const std::string& only = {});

    const std::vector<ColliderInfo>& all() const { return colliders_; }

    /// The folders that were looked through, separated by commas.
    std::string searched() const;

    /// Throws ColliderError when there is none of this name, or it was refused; the sentence lists
    /// those there are.
    const ColliderInfo& find(const std::string& name) const;

    /// The cheapest usable plugin that supports every pair of the scene, and why
    /// (choose_collider.h). Throws ColliderError where there is none.
    ColliderChoice choose(const Scene& scene) const;

    /// Throws ColliderError when the plugin lacks a pair of shapes that the scene needs: with the
    /// shape, the pair and the plugins that could do it.
    void check_abilities(const ColliderInfo& collider, const Scene& scene) const;

    /// Throws ColliderError when the plugin cannot make one.
    ProximityPtr create(const ColliderInfo& collider, std::uint32_t threads) const;

private:
    void add(const std::filesystem::path& file);

    std::vector<ColliderInfo> colliders_;
    std::vector<std::string> searched_;
};

}  // namespace plumb
