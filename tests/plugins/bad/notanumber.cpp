// SPDX-License-Identifier: MIT
/// A plugin that answers every question with one contact full of NaN.
#include "bad_plugin.h"

#include <limits>

namespace {

using namespace plumb;

class NotANumber final : public bad::Nothing {
public:
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
};

}  // namespace

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const PluginTable table = bad::table_for<NotANumber>("notanumber");
    return &table;
}
