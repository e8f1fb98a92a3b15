// SPDX-License-Identifier: MIT
/// The least of colliders: balls above the level ground y = 0.
#include <plumb/plugin.h>

#include <map>

namespace {

using namespace plumb;

class Level : public Proximity {
public:
    virtual ~Level() = default;

    Status add(std::uint32_t body, const ShapePlacement& placement) noexcept override {
        shapes_[body] = placement.shape;
        return ok_status();
    }
    Status remove(std::uint32_t body) noexcept override {
        shapes_.erase(body);
        return ok_status();
    }
    Status exclude(std::uint32_t, std::uint32_t, bool) noexcept override { return ok_status(); }
    DetectStats stats() const noexcept override { return {}; }

    /// The ground is body 0, so that a < b in every pair.
    Status detect(const DetectRequest& request, const ContactSink* sinks,
                  std::uint32_t) noexcept override {
        for (const auto& [body, shape] : shapes_) {
            if (shape.kind != ShapeKind::sphere) continue;
            const Vec3 centre = request.poses[body].position;
            const double sweep = request.sweeps ? request.sweeps[body] : 0;
            if (centre.y - shape.radius > request.margin + sweep) continue;
            Contact* c = sinks[0].grow(sinks[0].ctx, 1);
            if (!c) return {Status::out_of_memory, 1, "the sink takes no more"};
            *c = Contact{};
            c->b = body;
            c->feature = 1;
            c->point_a = {centre.x, 0, centre.z};
            c->point_b = centre;
            c->radius_b = shape.radius;
            c->normal = {0, -1, 0};
            c->gap = centre.y - shape.radius;
            c->flags = kContactExact;
        }
        return ok_status();
    }

private:
    std::map<std::uint32_t, Shape> shapes_;
};

PluginTable make_table() {
    PluginTable t{};
    t.magic = kPluginMagic;
    t.abi_major = kAbiMajor;
    t.abi_minor = kAbiMinor;
    t.table_size = sizeof(PluginTable);
    t.sizes = abi_sizes();
    t.name = "level";
    t.description = "balls on level ground";
    t.backend_version = "level 1";
    t.precision = "double";
    constexpr auto plane = static_cast<std::uint32_t>(ShapeKind::plane);
    constexpr auto sphere = static_cast<std::uint32_t>(ShapeKind::sphere);
    t.pairs[plane][sphere] = t.pairs[sphere][plane] = kPairManifold | kPairSeparated;
    t.create = [](const CreateRequest*, const char**) -> Proximity* { return new Level; };
    t.destroy = [](Proximity* p) { delete static_cast<Level*>(p); };
    return t;
}

}  // namespace

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin() {
    static const PluginTable table = make_table();
    return &table;
}
