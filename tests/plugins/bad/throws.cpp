// SPDX-License-Identifier: MIT
/// Plugins that let an exception out of a call that must not throw: in the twentieth detection, on
/// the calling thread or on one of their own, or when the first body is added.
#include "bad_plugin.h"

#include <stdexcept>
#include <string_view>
#include <thread>

namespace {

using namespace plumb;
constexpr std::string_view kKind = PLUMB_BAD_KIND;

[[noreturn]] void give_up() { throw std::runtime_error("the tree has lost its root"); }

class Throws final : public bad::Nothing {
public:
    Status add(std::uint32_t, const ShapePlacement&) noexcept override {
        if (kKind == "throws_at_once") give_up();
        return ok_status();
    }
    Status detect(const DetectRequest&, const ContactSink*, std::uint32_t) noexcept override {
        if (++calls_ < 20) return ok_status();
        if (kKind == "throws") give_up();
        if (kKind == "terminates") std::terminate();
        std::thread(give_up).join();
        return ok_status();
    }

private:
    int calls_ = 0;
};

}  // namespace

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const PluginTable table = bad::table_for<Throws>(PLUMB_BAD_KIND);
    return &table;
}
