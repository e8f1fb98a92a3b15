// SPDX-License-Identifier: MIT
/// A collider that finds nothing and fails: in every seventh call, or from the twentieth on
/// (PLUMB_FAILS_FOR_GOOD); or one that ends its process in the twentieth call (PLUMB_ABORTS).
#include <plumb/plugin.h>

#include <cstdint>
#include <cstdlib>

namespace {

using namespace plumb;

class Failing final : public Proximity {
public:
    Status add(std::uint32_t, const ShapePlacement&) noexcept override { return ok_status(); }
    Status remove(std::uint32_t) noexcept override { return ok_status(); }
    Status exclude(std::uint32_t, std::uint32_t, bool) noexcept override { return ok_status(); }
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
    DetectStats stats() const noexcept override { return {}; }

private:
    std::uint64_t calls_ = 0;
};

Proximity* create(const CreateRequest*, const char**) { return new Failing; }
void destroy(Proximity* proximity) { delete static_cast<Failing*>(proximity); }

PluginTable make_table() {
    PluginTable t{};
    t.magic = kPluginMagic;
    t.abi_major = kAbiMajor;
    t.abi_minor = kAbiMinor;
    t.table_size = sizeof(PluginTable);
    t.sizes = abi_sizes();
    t.name = PLUMB_COLLIDER_NAME;
    t.description = "fails, for tests of the program";
    t.backend_version = "none";
    t.precision = "double";
    for (auto& row : t.pairs)
        for (auto& bits : row) bits = kPairPoint;
    t.create = create;
    t.destroy = destroy;
    return t;
}

}  // namespace

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const PluginTable table = make_table();
    return &table;
}
