// SPDX-License-Identifier: MIT
/// A plugin of another major version: a host must refuse it before it reads anything else.
#include <plumb/plugin.h>

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const plumb::PluginTable table = [] {
        plumb::PluginTable t{};
        t.magic = plumb::kPluginMagic;
        t.abi_major = plumb::kAbiMajor + 1;
        t.table_size = sizeof(plumb::PluginTable);
        t.name = "oldabi";
        return t;
    }();
    return &table;
}
