// SPDX-License-Identifier: MIT
/// The reference collider: no package behind it, closed forms and exact separating axes.
///
/// It shares the table of bodies with the other plugins, but neither their support-face clipping
/// nor any back-end, so that agreement between it and them means something.
#include "manifold/plugin_table.h"
#include "reference/costs.h"
#include "reference/narrow.h"
#include "reference/sweep.h"

namespace plumb::reference {
namespace {

constexpr Supported kSupported{
    {true, true, true, true, false, false, false, false, false, true},
    "the reference collider knows plane, sphere, box, capsule and compounds "
    "of these; ode or bullet know more"};

class Reference final : public Collider {
public:
    explicit Reference(std::uint32_t threads) : Collider(kSupported, threads) {}

private:
    void find_pairs(std::vector<PartPair>& pairs) override { reference::find_pairs(pairs, table_); }

    bool sees_far_balls() const override { return true; }

    void collide_block(const NarrowOutput& out, const PartPair* pairs, std::size_t count, bool,
                       std::uint32_t) override {
        for (std::size_t i = 0; i < count; ++i)
            collide(out.contacts, table_.parts()[pairs[i].first], table_.parts()[pairs[i].second]);
        out.stats.from_backend = out.contacts.size();
    }
};

PluginTable make_table() {
    PluginTable t = blank_table();
    t.name = "reference";
    t.description = "closed forms and exact separating axes; no package behind it";
    t.backend_version = "Plumb reference 1";
    fill_pairs(t, kSupported, built_ability);
    fill_costs(t, kCosts);
    t.create = create_collider<Reference>;
    t.destroy = destroy_collider<Reference>;
    return t;
}

}  // namespace
}  // namespace plumb::reference

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const plumb::PluginTable table = plumb::reference::make_table();
    return &table;
}
