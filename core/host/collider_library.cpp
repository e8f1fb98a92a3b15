// SPDX-License-Identifier: MIT
#include "host/collider_library.h"

#include "host/shape_pairs.h"
#include "scene/error.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace plumb {
namespace {

namespace fs = std::filesystem;
constexpr const char* kFilePrefix = "plumb_collider_";

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

std::string name_of_file(const fs::path& file) {
    const std::string stem = file.stem().string();
    return stem.rfind(kFilePrefix, 0) == 0 ? stem.substr(std::strlen(kFilePrefix)) : stem;
}

/// Why a table cannot be used, or nothing.
std::string refusal_of(const PluginTable& t) {
    if (t.magic != kPluginMagic) return "its table does not begin with Plumb's magic number";
    if (t.abi_major != kAbiMajor)
        return "it was built for version " + std::to_string(t.abi_major) +
               " of the plugin interface, and this is version " + std::to_string(kAbiMajor) +
               "; rebuild it against the installed headers";
    if (t.table_size < sizeof(PluginTable))
        return "its table is smaller than this version's; rebuild it";
    const AbiSizes mine = abi_sizes();
    if (std::memcmp(&t.sizes, &mine, sizeof mine) != 0)
        return "its structs have other sizes than this host's; rebuild it against the installed "
               "headers";
    if (!t.name || !t.create || !t.destroy) return "its table lacks a name or a function";
    return {};
}

ColliderInfo load(const fs::path& file) {
    ColliderInfo info{file, nullptr, name_of_file(file), {}};
    void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
        const char* why = dlerror();
        info.refusal = std::string("it cannot be loaded: ") + (why ? why : "no reason given");
        return info;
    }
    const auto entry = reinterpret_cast<PluginEntry>(dlsym(handle, kPluginSymbol));
    const PluginTable* table = entry ? entry() : nullptr;
    if (!table)
        info.refusal = std::string("it does not export ") + kPluginSymbol;
    else
        info.refusal = refusal_of(*table);
    if (!info.refusal.empty()) {
        dlclose(handle);
        return info;
    }
    info.table = table;
    info.name = table->name;
    return info;
}

std::string names_of(const std::vector<ColliderInfo>& colliders) {
    std::string names;
    for (const ColliderInfo& c : colliders)
        if (c.table) names += (names.empty() ? "" : ", ") + c.name;
    return names.empty() ? "none" : names;
}

bool supports(const ColliderInfo& c, const ShapePairNeed& need) {
    const std::uint32_t ability =
        c.table->pairs[static_cast<std::size_t>(need.a)][static_cast<std::size_t>(need.b)];
    if (need.moving_mesh && !(ability & kPairMovingMesh)) return false;
    return (ability & (kPairPoint | kPairManifold)) != 0;
}

}  // namespace

ColliderLibrary::ColliderLibrary(const std::string& extra_path) {
    add_directories(searched_, extra_path.c_str());
    add_directories(searched_, std::getenv("PLUMB_PLUGIN_PATH"));
    const fs::path own = own_directory();
    for (const char* relative : {"../lib/plumb/plugins", "plumb/plugins", "../plumb/plugins"})
        searched_.push_back((own / relative).lexically_normal().string());

    for (const std::string& directory : searched_) {
        std::error_code ignored;
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(directory, ignored))
            if (entry.path().extension() == ".so" &&
                entry.path().filename().string().rfind(kFilePrefix, 0) == 0)
                files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files) {
            const bool known = std::any_of(
                colliders_.begin(), colliders_.end(),
                [&](const ColliderInfo& c) { return c.table && c.name == name_of_file(file); });
            if (!known) colliders_.push_back(load(file));
        }
    }
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
    std::string searched;
    for (const std::string& d : searched_) searched += (searched.empty() ? "" : ", ") + d;
    throw ColliderError("there is no collider \"" + name + "\"; installed are: " +
                        names_of(colliders_) + " (searched " + searched + ")");
}

const ColliderInfo& ColliderLibrary::choose(const Scene& scene) const {
    const std::vector<ShapePairNeed> needs = shape_pair_needs(scene);
    for (const char* preferred : {"ode", "bullet", "reference"})
        for (const ColliderInfo& c : colliders_)
            if (c.table && c.name == preferred &&
                std::all_of(needs.begin(), needs.end(),
                            [&](const ShapePairNeed& n) { return supports(c, n); }))
                return c;
    for (const ColliderInfo& c : colliders_)
        if (c.table && std::all_of(needs.begin(), needs.end(),
                                   [&](const ShapePairNeed& n) { return supports(c, n); }))
            return c;
    throw ColliderError(
        "no installed collider supports every pair of shapes of the scene; installed are: " +
        names_of(colliders_));
}

void ColliderLibrary::check_abilities(const ColliderInfo& collider, const Scene& scene) const {
    for (const ShapePairNeed& need : shape_pair_needs(scene)) {
        if (supports(collider, need)) continue;
        std::string able;
        for (const ColliderInfo& c : colliders_)
            if (c.table && supports(c, need)) able += (able.empty() ? "" : ", ") + c.name;
        throw ColliderError("collider \"" + collider.name + "\" cannot detect " +
                            (need.moving_mesh ? "moving " : "") + name_of(need.a) + " against " +
                            name_of(need.b) + ", which the scene needs (" + need.example + "); " +
                            (able.empty() ? "no installed collider can" : "able are: " + able));
    }
}

ProximityPtr ColliderLibrary::create(const ColliderInfo& collider, std::uint32_t threads) const {
    const CreateRequest request{threads, 0, nullptr};
    const char* message = nullptr;
    Proximity* p = collider.table->create(&request, &message);
    if (!p)
        throw ColliderError("collider \"" + collider.name +
                            "\" could not be made: " + (message ? message : "it gave no reason"));
    return ProximityPtr(p, ProximityDeleter{collider.table->destroy});
}

}  // namespace plumb
