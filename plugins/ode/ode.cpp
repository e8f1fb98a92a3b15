// SPDX-License-Identifier: MIT
/// The collider on ODE 0.16: native pairs and shared support-face clipping. The broad phase is the
/// shared grid: over the bounds of a pile of 2000 bodies ODE's hash space took a third of all of
/// `detect`.
#include "manifold/collider.h"
#include "manifold/grid.h"
#include "ode/narrow.h"

#include <stdexcept>

namespace plumb::ode {
namespace {

constexpr Supported kSupported{
    {true, true, true, true, true, false, true, true, false, true},
    "ode has no cones and no height fields; bullet has cones, and a height field can be "
    "given as a mesh"};

bool both(const Part& a, const Part& b, ShapeKind p, ShapeKind q) {
    return (a.shape.kind == p && b.shape.kind == q) || (a.shape.kind == q && b.shape.kind == p);
}

class Ode final : public Collider {
public:
    explicit Ode(std::uint32_t threads) : Collider(kSupported, threads) {}

private:
    void prepare(Part& part) override {
        know_thread();
        part.backend = make_geoms(part);
    }

    void find_pairs(std::vector<PartPair>& pairs) override {
        know_thread();
        grid_.find_pairs(pairs, table_);
    }

    void place_parts() override {
        double reach = 0;
        for (const Part& part : table_.parts())
            reach = std::max(reach, part.present ? part.reach : 0);
        for (const Part& part : table_.parts())
            if (part.present) place_geoms(part, 2 * reach);
    }

    void collide_block(const NarrowOutput& out, const PartPair* pairs, std::size_t count, bool raw,
                       std::uint32_t) override {
        know_thread();
        for (std::size_t i = 0; i < count; ++i) {
            try {
                collide({out.contacts, out.stats}, table_.parts()[pairs[i].first],
                        table_.parts()[pairs[i].second], raw);
            } catch (const std::runtime_error&) {
                ++out.failures;  // ODE gave up on this pair; the others go on
            }
        }
    }

    static void collide(const Output& out, const Part& a, const Part& b, bool raw) {
        if (both(a, b, ShapeKind::hull, ShapeKind::mesh))
            return;  // refused in the table: ODE finds nothing
        const bool mesh = a.shape.kind == ShapeKind::mesh || b.shape.kind == ShapeKind::mesh;
        (raw ? collide_raw : mesh ? collide_mesh : collide_convex)(out, a, b);
    }

    /// ODE keeps scratch memory for each thread.
    static void know_thread() {
        thread_local const int known = dAllocateODEDataForThread(dAllocateMaskAll);
        (void)known;
    }

    Grid grid_;
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
    const char* trouble = "ODE could not be started, or was built for single precision";
    try {
        if (start_ode()) return new Ode(request->threads);
    } catch (...) {
        trouble = "memory ran out";
    }
    if (message) *message = trouble;
    return nullptr;
}
void destroy(Proximity* proximity) { delete static_cast<Ode*>(proximity); }

std::uint32_t ability(ShapeKind a, ShapeKind b) {
    const auto has = [&](ShapeKind k) { return a == k || b == k; };
    if (a == b && a == ShapeKind::plane) return kPairNone;
    if (!has(ShapeKind::mesh)) return kPairPoint | kPairManifold | kPairSeparated | kPairThreadSafe;
    if (has(ShapeKind::hull) || has(ShapeKind::compound))
        return has(ShapeKind::hull) ? kPairNone : kPairPoint;
    std::uint32_t bits = kPairPoint | kPairManifold | kPairMovingMesh;
    if (has(ShapeKind::sphere) || has(ShapeKind::plane)) bits |= kPairSeparated;
    return bits;
}

PluginTable make_table() {
    PluginTable t = blank_table();
    t.name = "ode";
    t.description = "Open Dynamics Engine: native pairs, shared clipping";
    t.backend_version = "ODE 0.16.2";
    for (std::uint32_t i = 0; i < kShapeKindCount; ++i)
        for (std::uint32_t j = 0; j < kShapeKindCount; ++j)
            if (kSupported.kind[i] && kSupported.kind[j])
                t.pairs[i][j] = ability(static_cast<ShapeKind>(i), static_cast<ShapeKind>(j));
    t.create = create;
    t.destroy = destroy;
    return t;
}

}  // namespace
}  // namespace plumb::ode

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void) {
    static const plumb::PluginTable table = plumb::ode::make_table();
    return &table;
}
