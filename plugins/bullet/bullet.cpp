// SPDX-License-Identifier: MIT
/// The collider on Bullet 3.24 in double precision: tree of volumes, closest points, shared
/// support-face clipping.
#include "bullet/broad.h"
#include "bullet/costs.h"
#include "bullet/narrow.h"
#include "manifold/plugin_table.h"

namespace plumb::bullet {
namespace {

#ifndef BT_USE_DOUBLE_PRECISION
#error "this plugin needs bullet-float64: pkg-config bullet-float64 defines BT_USE_DOUBLE_PRECISION"
#endif

constexpr Supported kSupported{{true, true, true, true, true, true, true, true, true, true},
                               "bullet does not know this kind of shape"};

class Bullet final : public Collider {
public:
    explicit Bullet(std::uint32_t threads) : Collider(kSupported, threads) {
        for (std::uint32_t i = 0; i < this->threads(); ++i)
            narrow_.push_back(std::make_unique<Narrow>());
    }

private:
    void prepare(Part& part) override { part.backend = make_shapes(part); }

    void find_pairs(std::vector<PartPair>& pairs) override { tree_.find_pairs(pairs, table_); }

    void place_parts() override {
        for (const Part& part : table_.parts())
            if (part.present) place_shapes(part);
    }

    void collide_block(const NarrowOutput& out, const PartPair* pairs, std::size_t count, bool raw,
                       std::uint32_t worker) override {
        Narrow& narrow = *narrow_[worker];
        for (std::size_t i = 0; i < count; ++i) {
            const Part &a = table_.parts()[pairs[i].first], &b = table_.parts()[pairs[i].second];
            const bool mesh = has_surface(a.shape.kind) || has_surface(b.shape.kind);
            if (!built_ability(a.shape.kind, b.shape.kind)) continue;
            if (raw)
                narrow.collide_raw(out.contacts, out.stats, a, b);
            else if (mesh)
                narrow.collide_mesh(out.contacts, out.stats, a, b);
            else
                narrow.collide_convex(out.contacts, out.stats, a, b);
        }
    }

    Tree tree_;
    std::vector<std::unique_ptr<Narrow>> narrow_;  ///< [worker]
};

PluginTable make_table() {
    PluginTable t = blank_table();
    t.name = "bullet";
    t.description =
        "Bullet Physics in double precision: volume tree, closest points, shared clipping";
    t.backend_version = "Bullet 3.24";
    fill_pairs(t, kSupported, built_ability);
    fill_costs(t, kCosts);
    t.create = create_collider<Bullet>;
    t.destroy = destroy_collider<Bullet>;
    return t;
}

}  // namespace
}  // namespace plumb::bullet

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const plumb::PluginTable table = plumb::bullet::make_table();
    return &table;
}
