// SPDX-License-Identifier: MIT
/// The colliders that a comparison asks, each in this process or in one of its own.
#pragma once

#include "app/run_options.h"
#include "host/contact_source.h"

#include <memory>
#include <string>
#include <vector>

namespace plumb::app {

struct SourceChoice {
    std::vector<std::string> names;
    std::string driver;  ///< one of the names; it stays in this process
    bool isolate;        ///< all others get processes of their own
};

struct Sources {
    std::vector<std::unique_ptr<ContactSource>> all;  ///< [name]
    std::vector<bool> own_process;                    ///< [name]
};

/// Makes a source of each name. One whose plugin must not share a process with another of them,
/// that stands before it, gets a process of its own (PluginTable::conflicts). Throws ColliderError,
/// SceneError.
Sources make_sources(const SourceChoice& choice, const Scene& scene,
                     const ColliderLibrary& colliders, const RunOptions& options);

/// What the process of such a source does: answers with one collider until it is told no more.
void answer_only(const std::string& name, const RunOptions& options);

}  // namespace plumb::app
