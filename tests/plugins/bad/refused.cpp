// SPDX-License-Identifier: MIT
/// Plugins of this version that a host must refuse all the same: each PLUMB_BAD_KIND has one fault.
#include "bad_plugin.h"

#include <stdexcept>
#include <string_view>

namespace {

using namespace plumb;
constexpr std::string_view kKind = PLUMB_BAD_KIND;

PluginTable faulty_table() {
    PluginTable t = bad::table_for<bad::Nothing>(PLUMB_BAD_KIND);
    if (kKind == "taken") t.name = "reference";
    if (kKind == "nameless") t.name = nullptr;
    if (kKind == "untold") t.description = t.backend_version = nullptr;
    if (kKind == "imprecise") t.precision = "half";
    if (kKind == "helpless") t.destroy = nullptr;
    if (kKind == "short") t.table_size = 8;
    if (kKind == "resized") ++t.sizes.contact;
    if (kKind == "unmade")
        t.create = [](const CreateRequest*, const char**) -> Proximity* { return nullptr; };
    if (kKind == "throws_made")
        t.create = [](const CreateRequest*, const char**) -> Proximity* {
            throw std::runtime_error("no licence was found");
        };
    return t;
}

}  // namespace

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    if (kKind == "tableless") return nullptr;
    if (kKind == "throws_loaded") throw std::runtime_error("the entry will not have it");
    static const PluginTable table = faulty_table();
    return &table;
}
