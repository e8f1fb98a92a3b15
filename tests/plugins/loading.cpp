// SPDX-License-Identifier: MIT
#include "loading.h"

#include "host/load_plugin.h"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <map>
#include <mutex>
#include <set>
#include <sstream>

namespace plumb::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string>& chosen() {
    static std::vector<std::string> names;
    return names;
}

std::vector<std::string> split(const std::string& list, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(list);
    for (std::string part; std::getline(stream, part, separator);)
        if (!part.empty()) parts.push_back(part);
    return parts;
}

[[noreturn]] void give_up(const std::string& sentence) {
    std::cerr << sentence << std::endl;
    std::_Exit(1);
}

const ColliderInfo& loaded(const std::string& name) {
    static std::mutex lock;
    const std::lock_guard<std::mutex> guard(lock);
    static std::map<std::string, ColliderInfo> plugins;
    const auto known = plugins.find(name);
    if (known != plugins.end()) return known->second;
    const std::string file = plugin_file(name);
    if (file.empty()) give_up("there is no collision plugin " + name);
    return plugins[name] = load_plugin(file);
}

bool names(const char* list, const char* name) {
    for (const std::string& each : split(list ? list : "", ','))
        if (each.substr(each.find_first_not_of(' ')) == name) return true;
    return false;
}

}  // namespace

std::string plugin_file(const std::string& name) {
    std::error_code ignored;
    if (name.find('/') != std::string::npos || fs::path(name).extension() == ".so")
        return fs::exists(name, ignored) ? fs::absolute(name).string() : std::string();
    const char* path = std::getenv("PLUMB_PLUGIN_PATH");
    std::vector<std::string> folders = split(path ? path : "", ':');
    const fs::path own = fs::canonical("/proc/self/exe", ignored).parent_path();
    folders.push_back((own / "../lib/plumb/plugins").lexically_normal().string());
    for (const std::string& folder : folders) {
        const fs::path file = fs::path(folder) / ("plumb_collider_" + name + ".so");
        if (fs::exists(file, ignored)) return file.string();
    }
    return {};
}

std::string refusal(const std::string& name) { return loaded(name).refusal; }

const PluginTable& plugin(const std::string& name) {
    const ColliderInfo& info = loaded(name);
    if (!info.table) give_up(info.file.string() + " was refused: " + info.refusal);
    return *info.table;
}

std::vector<std::string> plugin_names() {
    return chosen().empty() ? split(PLUMB_TEST_PLUGINS, ',') : chosen();
}

void choose_plugins(const std::vector<std::string>& names) { chosen() = names; }

std::uint32_t ability(const std::string& name, ShapeKind a, ShapeKind b) {
    return plugin(name).pairs[static_cast<std::uint32_t>(a)][static_cast<std::uint32_t>(b)];
}

bool takes(const std::string& name, ShapeKind kind) {
    for (std::uint32_t k = 0; k < kShapeKindCount; ++k)
        if (ability(name, kind, static_cast<ShapeKind>(k)) != kPairNone) return true;
    return false;
}

std::string note_use(const std::string& name) {
    static std::set<const PluginTable*> used;
    const PluginTable& table = plugin(name);
    for (const PluginTable* other : used)
        if (names(table.conflicts, other->name) || names(other->conflicts, table.name))
            return other->name;
    used.insert(&table);
    return {};
}

double relative_accuracy(const std::string& name) {
    return std::strcmp(plugin(name).precision, "single") == 0 ? 2e-4 : 2e-5;
}

}  // namespace plumb::test
