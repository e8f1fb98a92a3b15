// SPDX-License-Identifier: MIT
/// The plugin `bullet`, or `bullet_float` where PLUMB_BULLET_SINGLE is defined: the table, without
/// Bullet. The collider is in the backend that is loaded when one is asked for.
#include "bullet/costs.h"
#include "bullet/load_backend.h"
#include "bullet/supported.h"

namespace plumb::bullet {
namespace {

Proximity* create(const CreateRequest* request, const char** message) {
    try {
        const Backend& backend = load_backend();
        if (backend.create) return backend.create(request, message);
        if (message) *message = backend.refusal.c_str();
    } catch (...) {
        if (message) *message = "memory ran out";
    }
    return nullptr;
}
void destroy(Proximity* proximity) { load_backend().destroy(proximity); }

PluginTable make_table() {
    PluginTable t = blank_table();
#ifdef PLUMB_BULLET_SINGLE
    t.name = "bullet_float";
    t.description =
        "Bullet Physics in single precision: volume tree, closest points, shared clipping";
    t.precision = "single";
    t.conflicts = "bullet";
#else
    t.name = "bullet";
    t.description =
        "Bullet Physics in double precision: volume tree, closest points, shared clipping";
    t.conflicts = "bullet_float";
    fill_costs(t, kCosts);
#endif
    t.backend_version = "Bullet 3.24";
    fill_pairs(t, kSupported, built_ability);
    t.create = create;
    t.destroy = destroy;
    return t;
}

}  // namespace
}  // namespace plumb::bullet

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const plumb::PluginTable table = plumb::bullet::make_table();
    return &table;
}
