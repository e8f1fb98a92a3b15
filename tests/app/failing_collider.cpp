// SPDX-License-Identifier: MIT
/// A collider that finds nothing and fails: in every seventh call, or from the twentieth on
/// (PLUMB_FAILS_FOR_GOOD); or one that ends its process in the twentieth call (PLUMB_ABORTS).
#include "bad_plugin.h"

#include <cstdlib>

namespace {

using namespace plumb;

class Failing final : public bad::Nothing {
public:
    Status detect(const DetectRequest&, const ContactSink*, std::uint32_t) noexcept override {
        ++calls_;
#ifdef PLUMB_ABORTS
        if (calls_ >= 20) std::abort();
#endif
#ifdef PLUMB_FAILS_FOR_GOOD
        const bool fails = calls_ >= 20;
#else
        const bool fails = calls_ % 7 == 0;
#endif
        return fails ? Status{Status::failed, 1, "made to fail"} : ok_status();
    }

private:
    std::uint64_t calls_ = 0;
};

}  // namespace

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const PluginTable table = bad::table_for<Failing>(PLUMB_COLLIDER_NAME);
    return &table;
}
