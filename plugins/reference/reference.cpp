// SPDX-License-Identifier: MIT
/// The reference collider: no package behind it, closed forms and exact separating axes.
///
/// It shares the table of bodies with the other plugins, but neither their support-face clipping
/// nor any back-end, so that agreement between it and them means something.
#include "reference/narrow.h"
#include "reference/sweep.h"

#include <new>

namespace plumb::reference {
namespace {

constexpr bool kSupported[kShapeKindCount] = {true,  true,  true,  true,  false,
                                              false, false, false, false, true};
constexpr const char* kRefusal =
    "the reference collider knows plane, sphere, box, capsule and compounds of these; ode or "
    "bullet know more";

class Reference final : public Proximity {
public:
    Status add(std::uint32_t body, const ShapePlacement& placement) noexcept override {
        return guarded([&] { return table_.add(body, placement, kSupported, kRefusal); });
    }
    Status remove(std::uint32_t body) noexcept override {
        return guarded([&] { return table_.remove(body); });
    }
    Status exclude(std::uint32_t a, std::uint32_t b, bool excluded) noexcept override {
        return guarded([&] { return table_.exclude(a, b, excluded); });
    }
    Status detect(const DetectRequest& request, const ContactSink* sinks,
                  std::uint32_t count) noexcept override {
        return guarded([&] { return detect_all(request, sinks, count); });
    }
    DetectStats stats() const noexcept override { return stats_; }

private:
    template <class F>
    Status guarded(F f) noexcept {
        try {
            return f();
        } catch (const std::bad_alloc&) {
            return {Status::out_of_memory, 0, "memory ran out"};
        } catch (...) {
            return {Status::failed, 0, "an unexpected exception was caught"};
        }
    }

    Status detect_all(const DetectRequest& request, const ContactSink* sinks,
                      std::uint32_t sink_count) {
        stats_ = {};
        contacts_.clear();
        const Status placed = table_.place(request);
        if (placed.code == Status::bad_argument) return placed;

        find_pairs(pairs_, table_);
        for (const PartPair& pair : pairs_)
            collide(contacts_, table_.parts()[pair.first], table_.parts()[pair.second]);
        contacts_.finish();

        stats_.broad_pairs = pairs_.size();
        stats_.narrow_pairs = contacts_.pair_count();
        stats_.from_backend = contacts_.size();
        const Status written = contacts_.write_to(sinks, sink_count);
        return written.code == Status::ok ? placed : written;
    }

    BodyTable table_;
    std::vector<PartPair> pairs_;
    ContactList contacts_;
    DetectStats stats_{};
};

Proximity* create(const CreateRequest*, const char** message) {
    Reference* made = new (std::nothrow) Reference;
    if (!made && message) *message = "memory ran out";
    return made;
}
void destroy(Proximity* proximity) { delete static_cast<Reference*>(proximity); }

PluginTable make_table() {
    PluginTable t{};
    t.magic = kPluginMagic;
    t.abi_major = kAbiMajor;
    t.abi_minor = kAbiMinor;
    t.table_size = sizeof(PluginTable);
    t.sizes = abi_sizes();
    t.name = "reference";
    t.description = "closed forms and exact separating axes; no package behind it";
    t.backend_version = "Plumb reference 1";
    t.precision = "double";
    for (std::uint32_t i = 0; i < kShapeKindCount; ++i)
        for (std::uint32_t j = 0; j < kShapeKindCount; ++j) {
            const bool planes = i == 0 && j == 0;
            if (kSupported[i] && kSupported[j] && !planes)
                t.pairs[i][j] = kPairPoint | kPairManifold | kPairSeparated;
        }
    t.create = create;
    t.destroy = destroy;
    return t;
}

}  // namespace
}  // namespace plumb::reference

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const plumb::PluginTable table = plumb::reference::make_table();
    return &table;
}
