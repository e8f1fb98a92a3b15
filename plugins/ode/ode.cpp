// SPDX-License-Identifier: MIT
/// The collider on ODE 0.16: native pairs and shared support-face clipping. The broad phase is the
/// shared grid: over the bounds of a pile of 2000 bodies ODE's hash space took a third of all of
/// `detect`.
#include "manifold/grid.h"
#include "manifold/plugin_table.h"
#include "ode/costs.h"
#include "ode/narrow.h"

#include <stdexcept>

namespace plumb::ode {
namespace {

constexpr Supported kSupported{{true, true, true, true, true, false, true, true, true, true},
                               "ode has no cones; bullet has them"};

class Ode final : public Collider {
public:
    explicit Ode(std::uint32_t threads) : Collider(kSupported, threads) {
        for (std::uint32_t i = 0; i < this->threads(); ++i)
            workspaces_.push_back(std::make_unique<Workspace>());
    }

private:
    void prepare(Part& part) override {
        know_thread();
        part.backend = make_geoms(part);
    }

    void find_pairs(std::vector<PartPair>& pairs) override {
        know_thread();
        grid_.find_pairs(pairs, table_);
    }

    void place_parts(const PartPair* pairs, std::size_t count) override {
        const double wider_by = 2 * table_.greatest_expansion();
        each_part(pairs, count, [&](const Part& part) { place_geoms(part, wider_by); });
    }

    void collide_block(const NarrowOutput& out, const PartPair* pairs, std::size_t count, bool raw,
                       std::uint32_t worker) override {
        know_thread();
        for (std::size_t i = 0; i < count; ++i) {
            try {
                collide({out.contacts, out.stats}, table_.parts()[pairs[i].first],
                        table_.parts()[pairs[i].second], raw, *workspaces_[worker]);
            } catch (const std::runtime_error&) {
                ++out.failures;  // ODE gave up on this pair; the others go on
            }
        }
    }

    static void collide(const Output& out, const Part& a, const Part& b, bool raw,
                        Workspace& workspace) {
        if (!built_ability(a.shape.kind, b.shape.kind)) return;
        if (raw) return collide_raw(out, a, b);
        if (has_surface(a.shape.kind) || has_surface(b.shape.kind))
            return collide_mesh(out, a, b, workspace);
        collide_convex(out, a, b);
    }

    /// ODE keeps scratch memory for each thread.
    static void know_thread() {
        thread_local const int known = dAllocateODEDataForThread(dAllocateMaskAll);
        (void)known;
    }

    Grid grid_;
    std::vector<std::unique_ptr<Workspace>> workspaces_;  ///< [worker]
};

[[noreturn]] void give_up(int, const char*, va_list) { throw std::runtime_error("ODE gave up"); }
void keep_quiet(int, const char*, va_list) {}

/// Once a process, and never undone: other instances may be alive.
bool start_ode() {
    static const bool started = [] {
        dSetErrorHandler(give_up);
        dSetDebugHandler(give_up);
        dSetMessageHandler(keep_quiet);
        return dInitODE2(0) != 0 && dCheckConfiguration("ODE_double_precision") != 0;
    }();
    return started;
}

Proximity* create(const CreateRequest* request, const char** message) {
    try {
        if (start_ode()) return create_collider<Ode>(request, message);
    } catch (...) {
        // ODE's own start gave up
    }
    if (message) *message = "ODE could not be started, or was built for single precision";
    return nullptr;
}

PluginTable make_table() {
    PluginTable t = blank_table();
    t.name = "ode";
    t.description = "Open Dynamics Engine: native pairs, shared clipping";
    t.backend_version = "ODE 0.16.2";
    fill_pairs(t, kSupported, built_ability);
    fill_costs(t, kCosts);
    t.create = create;
    t.destroy = destroy_collider<Ode>;
    return t;
}

}  // namespace
}  // namespace plumb::ode

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const plumb::PluginTable table = plumb::ode::make_table();
    return &table;
}
