// SPDX-License-Identifier: MIT
#include "host/collider_library.h"

#include "host/collider_call.h"
#include "host/conflicts.h"
#include "host/exception_text.h"
#include "host/log.h"
#include "host/shape_pairs.h"
#include "host/watched_collider.h"
#include "scene/error.h"
#include "scene/nearest.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace plumb {
namespace {

namespace fs = std::filesystem;

/// Directories of a list separated by ':'.
void add_directories(std::vector<std::string>& to, const char* list) {
    std::stringstream stream(list ? list : "");
    for (std::string directory; std::getline(stream, directory, ':');)
        if (!directory.empty()) to.push_back(directory);
}

/// Where this code itself lives: the program or the shared library that it was linked into.
fs::path own_directory() {
    Dl_info info{};
    std::error_code ignored;
    if (dladdr(reinterpret_cast<const void*>(&own_directory), &info) && info.dli_fname) {
        const fs::path file = fs::canonical(info.dli_fname, ignored);
        if (!ignored) return file.parent_path();
    }
    return fs::canonical("/proc/self/exe", ignored).parent_path();
}

/// Plugins of a directory in the order of their names; none where it cannot be read.
std::vector<fs::path> plugin_files(const std::string& directory) {
    std::error_code error;
    std::vector<fs::path> files;
    for (fs::directory_iterator i(directory, error), end; !error && i != end; i.increment(error))
        if (is_plugin_file(i->path())) files.push_back(i->path());
    std::sort(files.begin(), files.end());
    return files;
}

std::string names_of(const std::vector<ColliderInfo>& colliders) {
    std::string names;
    for (const ColliderInfo& c : colliders)
        if (c.table) names += (names.empty() ? "" : ", ") + c.name;
    return names.empty() ? "none" : names;
}

/// " (did you mean "bullet"?)" where the name is nearly one that is installed, else nothing.
std::string spelling_advice(const std::string& name, const std::vector<ColliderInfo>& colliders) {
    std::vector<std::string> usable;
    for (const ColliderInfo& c : colliders)
        if (c.table) usable.push_back(c.name);
    const std::string near = nearest(name, usable);
    return near.empty() ? "" : " (did you mean \"" + near + "\"?)";
}

/// The plugins that can do a pair; "" where none can.
std::string names_of_able(const std::vector<ColliderInfo>& colliders, const ShapePairNeed& need) {
    std::string able;
    for (const ColliderInfo& c : colliders)
        if (c.table && supports(*c.table, need)) able += (able.empty() ? "" : ", ") + c.name;
    return able;
}

/// "moving mesh against cone, which the scene needs (body "a" and body "b")".
std::string text_of(const ShapePairNeed& need) {
    return std::string(need.moving_mesh ? "moving " : "") + name_of(need.a) + " against " +
           name_of(need.b) + ", which the scene needs (" + need.example + ")";
}

}  // namespace

ColliderLibrary::ColliderLibrary(const std::string& extra_path, const std::string& only) {
    add_directories(searched_, extra_path.c_str());
    add_directories(searched_, std::getenv("PLUMB_PLUGIN_PATH"));
    const fs::path own = own_directory();
    for (const char* relative : {"../lib/plumb/plugins", "plumb/plugins", "../plumb/plugins"})
        searched_.push_back((own / relative).lexically_normal().string());

    for (const std::string& directory : searched_)
        for (const fs::path& file : plugin_files(directory))
            if (only.empty() || plugin_name_of(file) == only) add(file);
}

void ColliderLibrary::add(const fs::path& file) {
    const auto usable = [this](const std::string& name) {
        return std::find_if(colliders_.begin(), colliders_.end(),
                            [&](const ColliderInfo& c) { return c.table && c.name == name; });
    };
    const auto shadowed_by = usable(plugin_name_of(file));
    if (shadowed_by != colliders_.end() && shadowed_by->file.filename() == file.filename()) {
        logger()->debug("plugin {} is skipped: {} stands before it", file.string(),
                        shadowed_by->file.string());
        return;
    }
    ColliderInfo info = load_plugin(file);
    const auto first = info.table ? usable(info.name) : colliders_.end();
    if (first != colliders_.end()) {
        info.refusal = "its name is \"" + info.name + "\", which " + first->file.string() +
                       " has already taken";
        info.name = plugin_name_of(file);
        info.table = nullptr;
    }
    if (info.table)
        logger()->debug("plugin {} is collider \"{}\"", file.string(), info.name);
    else
        logger()->debug("plugin {} is refused: {}", file.string(), info.refusal);
    colliders_.push_back(std::move(info));
}

const ColliderInfo& ColliderLibrary::find(const std::string& name) const {
    const ColliderInfo* refused = nullptr;
    for (const ColliderInfo& c : colliders_) {
        if (c.name != name) continue;
        if (c.table) return c;
        refused = &c;
    }
    if (refused)
        throw ColliderError("collider \"" + name + "\" (" + refused->file.string() +
                            ") was refused: " + refused->refusal);
    throw ColliderError(
        "there is no collider \"" + name + "\"" + spelling_advice(name, colliders_) +
        "; installed are: " + names_of(colliders_) + " (searched " + searched() + ")");
}

std::string ColliderLibrary::searched() const {
    std::string all;
    for (const std::string& d : searched_) all += (all.empty() ? "" : ", ") + d;
    return all;
}

ColliderChoice ColliderLibrary::choose(const Scene& scene) const {
    ColliderChoice choice = choose_collider(colliders_, scene);
    if (choice.collider) return choice;
    for (const ShapePairNeed& need : shape_pair_needs(scene))
        if (names_of_able(colliders_, need).empty())
            throw ColliderError("no installed collider can detect " + text_of(need) +
                                "; installed are: " + names_of(colliders_));
    throw ColliderError(
        "no installed collider supports every pair of shapes of the scene; installed are: " +
        names_of(colliders_));
}

void ColliderLibrary::check_abilities(const ColliderInfo& collider, const Scene& scene) const {
    for (const ShapePairNeed& need : shape_pair_needs(scene)) {
        if (supports(*collider.table, need)) continue;
        const std::string able = names_of_able(colliders_, need);
        throw ColliderError("collider \"" + collider.name + "\" cannot detect " + text_of(need) +
                            "; " +
                            (able.empty() ? "no installed collider can" : "able are: " + able));
    }
}

ProximityPtr ColliderLibrary::create(const ColliderInfo& collider, std::uint32_t threads) const {
    const std::string conflict = conflict_of(*collider.table);
    if (!conflict.empty())
        throw ColliderError("collider \"" + collider.name + "\" must not share a process with \"" +
                            conflict +
                            "\", which this one has used; run it in a process of its own");
    const CreateRequest request{threads, 0, nullptr};
    const char* message = nullptr;
    Proximity* p = nullptr;
    try {
        const ColliderCall call(collider.table->name, "create");
        p = collider.table->create(&request, &message);
    } catch (...) {
        throw ColliderError("collider \"" + collider.name +
                            "\" could not be made: it threw: " + exception_text());
    }
    if (!p)
        throw ColliderError("collider \"" + collider.name +
                            "\" could not be made: " + (message ? message : "it gave no reason"));
    note_use(*collider.table);
    const auto destroy = [](Proximity* watched) { delete static_cast<WatchedCollider*>(watched); };
    return ProximityPtr(new WatchedCollider(*p, *collider.table), ProximityDeleter{destroy});
}

}  // namespace plumb
