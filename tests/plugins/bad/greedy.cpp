// SPDX-License-Identifier: MIT
/// Plugins that do not keep to the room of their sink: from the twentieth detection on, `overruns`
/// writes more contacts than it asked for, and `floods` asks for hundreds of millions.
#include "bad_plugin.h"

#include <string_view>

namespace {

using namespace plumb;
constexpr std::string_view kKind = PLUMB_BAD_KIND;

class Greedy final : public bad::Nothing {
public:
    Status detect(const DetectRequest&, const ContactSink* sinks, std::uint32_t) noexcept override {
        if (++calls_ < 20) return ok_status();
        const bool floods = kKind == "floods";
        Contact* room = sinks[0].grow(sinks[0].ctx, floods ? 300'000'000 : 2);
        if (!room) return {Status::out_of_memory, 0, "there is no room"};
        for (int i = 0; i < 5; ++i) room[i] = {};
        return ok_status();
    }

private:
    int calls_ = 0;
};

}  // namespace

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const PluginTable table = bad::table_for<Greedy>(PLUMB_BAD_KIND);
    return &table;
}
