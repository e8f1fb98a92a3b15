// SPDX-License-Identifier: MIT
#include "app/contact_sources.h"

#include "host/conflicts.h"
#include "host/remote_source.h"

#include <algorithm>
#include <csignal>

namespace plumb::app {
namespace {

bool conflict(const ColliderLibrary& colliders, const std::string& x, const std::string& y) {
    return x != y && conflicting(*colliders.find(x).table, *colliders.find(y).table);
}

std::vector<std::string> answering_command(const std::string& name, const RunOptions& options) {
    std::vector<std::string> command{"/proc/self/exe", "compare", options.scene, "--answer-only",
                                     name};
    if (!options.plugin_path.empty())
        command.insert(command.end(), {"--plugin-path", options.plugin_path});
    return command;
}

struct Asked {
    const std::string& name;
    const RunOptions& options;
};

ContactSource* make_local(void* ctx) {
    const Asked& asked = *static_cast<Asked*>(ctx);
    const ColliderLibrary colliders(asked.options.plugin_path, asked.name);
    return new LocalSource(load_scene(asked.options), colliders, asked.name);
}

}  // namespace

Sources make_sources(const SourceChoice& choice, const Scene& scene,
                     const ColliderLibrary& colliders, const RunOptions& options) {
    Sources sources;
    std::vector<std::string> here{choice.driver};
    for (const std::string& name : choice.names) {
        const bool conflicts = std::any_of(here.begin(), here.end(), [&](const std::string& other) {
            return conflict(colliders, name, other);
        });
        const bool apart = conflicts || (choice.isolate && name != choice.driver);
        sources.own_process.push_back(apart);
        if (apart) {
            colliders.check_abilities(colliders.find(name), scene);
            sources.all.push_back(
                std::make_unique<RemoteSource>(name, answering_command(name, options)));
            continue;
        }
        sources.all.push_back(std::make_unique<LocalSource>(scene, colliders, name));
        here.push_back(name);
    }
    return sources;
}

void answer_only(const std::string& name, const RunOptions& options) {
    // Ctrl-C is for the parent, which ends this process when it has its results.
    std::signal(SIGINT, SIG_IGN);
    Asked asked{name, options};
    serve(RemoteSource::kDescriptor, make_local, &asked);
}

}  // namespace plumb::app
