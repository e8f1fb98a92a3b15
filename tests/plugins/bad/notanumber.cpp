// SPDX-License-Identifier: MIT
/// A plugin that answers every question with one contact full of NaN.
#include <plumb/plugin.h>

#include <limits>

namespace {

using namespace plumb;

class NotANumber final : public Proximity {
public:
    Status add(std::uint32_t, const ShapePlacement&) noexcept override { return ok_status(); }
    Status remove(std::uint32_t) noexcept override { return ok_status(); }
    Status exclude(std::uint32_t, std::uint32_t, bool) noexcept override { return ok_status(); }
    Status detect(const DetectRequest& request, const ContactSink* sinks,
                  std::uint32_t) noexcept override {
        if (request.body_count < 2) return ok_status();
        Contact* c = sinks[0].grow(sinks[0].ctx, 1);
        if (!c) return {Status::out_of_memory, 0, "the sink takes no more contacts"};
        const double nan = std::numeric_limits<double>::quiet_NaN();
        *c = {};
        c->b = 1;
        c->feature = 1;
        c->normal = {nan, nan, nan};
        c->point_a = c->point_b = {nan, nan, nan};
        c->gap = nan;
        c->flags = kContactExact;
        return ok_status();
    }
    DetectStats stats() const noexcept override { return {}; }
};

Proximity* create(const CreateRequest*, const char**) { return new NotANumber; }
void destroy(Proximity* proximity) { delete static_cast<NotANumber*>(proximity); }

}  // namespace

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const PluginTable table = [] {
        PluginTable t{};
        t.magic = kPluginMagic;
        t.abi_major = kAbiMajor;
        t.abi_minor = kAbiMinor;
        t.table_size = sizeof(PluginTable);
        t.sizes = abi_sizes();
        t.name = "notanumber";
        t.description = "answers NaN, for tests of the host";
        t.backend_version = "none";
        t.precision = "double";
        for (auto& row : t.pairs)
            for (auto& bits : row) bits = kPairPoint | kPairManifold | kPairSeparated;
        t.create = create;
        t.destroy = destroy;
        return t;
    }();
    return &table;
}
