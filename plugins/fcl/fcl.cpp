// SPDX-License-Identifier: MIT
/// The collider on FCL 0.7: dynamic tree, signed distance, shared support-face clipping.
#include "fcl/broad.h"
#include "fcl/costs.h"
#include "fcl/narrow.h"
#include "fcl/shapes.h"
#include "manifold/plugin_table.h"

#include <exception>
#include <new>

namespace plumb::by_fcl {
namespace {

constexpr Supported kSupported{{true, true, true, true, true, true, true, true, true, true},
                               "fcl does not know this kind of shape"};

class Fcl final : public Collider {
public:
    explicit Fcl(std::uint32_t threads) : Collider(kSupported, threads), narrow_(this->threads()) {}

private:
    void prepare(Part& part) override { part.backend = make_geometry(part); }

    void find_pairs(std::vector<PartPair>& pairs) override { tree_.find_pairs(pairs, table_); }

    void place_parts(const PartPair* pairs, std::size_t count) override {
        each_part(pairs, count, [](const Part& part) { place_geometry(part); });
    }

    void collide_block(const NarrowOutput& out, const PartPair* pairs, std::size_t count, bool raw,
                       std::uint32_t worker) override {
        for (std::size_t i = 0; i < count; ++i) {
            try {
                collide(narrow_[worker], out, table_.parts()[pairs[i].first],
                        table_.parts()[pairs[i].second], raw);
            } catch (const std::bad_alloc&) {
                throw;
            } catch (const std::exception&) {
                ++out.failures;  // FCL gave up on this pair; the others go on
            }
        }
    }

    static void collide(Narrow& narrow, const NarrowOutput& out, const Part& a, const Part& b,
                        bool raw) {
        const bool mesh = has_surface(a.shape.kind) || has_surface(b.shape.kind);
        if (!built_ability(a.shape.kind, b.shape.kind)) return;
        if (raw)
            narrow.collide_raw(out.contacts, out.stats, a, b);
        else if (mesh)
            narrow.collide_mesh(out.contacts, out.stats, a, b);
        else
            narrow.collide_convex(out.contacts, out.stats, a, b);
    }

    Tree tree_;
    std::vector<Narrow> narrow_;  ///< [worker]
};

PluginTable make_table() {
    PluginTable t = blank_table();
    t.name = "fcl";
    t.description = "Flexible Collision Library: dynamic tree, signed distance, shared clipping";
    t.backend_version = "FCL 0.7.0";
    fill_pairs(t, kSupported, built_ability);
    fill_costs(t, kCosts);
    t.create = create_collider<Fcl>;
    t.destroy = destroy_collider<Fcl>;
    return t;
}

}  // namespace
}  // namespace plumb::by_fcl

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const plumb::PluginTable table = plumb::by_fcl::make_table();
    return &table;
}
