// SPDX-License-Identifier: MIT
#include "host/conflicts.h"

#include <algorithm>
#include <mutex>
#include <sstream>
#include <string_view>
#include <vector>

namespace plumb {
namespace {

struct Used {
    std::mutex mutex;
    std::vector<const PluginTable*> tables;
};
Used& used() {
    static Used all;
    return all;
}

/// Whether a list "a, b" has a name.
bool names(const char* list, std::string_view wanted) {
    std::istringstream stream(list ? list : "");
    for (std::string name; std::getline(stream, name, ',');) {
        std::erase(name, ' ');
        if (name == wanted) return true;
    }
    return false;
}

}  // namespace

bool conflicting(const PluginTable& x, const PluginTable& y) {
    return names(x.conflicts, y.name) || names(y.conflicts, x.name);
}

std::string conflict_of(const PluginTable& table) {
    const std::lock_guard lock(used().mutex);
    for (const PluginTable* other : used().tables)
        if (conflicting(table, *other)) return other->name;
    return {};
}

void note_use(const PluginTable& table) {
    const std::lock_guard lock(used().mutex);
    std::vector<const PluginTable*>& tables = used().tables;
    if (std::find(tables.begin(), tables.end(), &table) == tables.end()) tables.push_back(&table);
}

}  // namespace plumb
