// SPDX-License-Identifier: MIT
/// A plugin's collider as the host hands it out: every call is marked as under way, and the counts
/// of the last detection are kept, so that they can be told when the collider is gone.
#pragma once

#include <plumb/plugin.h>

namespace plumb {

class WatchedCollider final : public Proximity {
public:
    /// Takes the collider over. The table must outlive it.
    WatchedCollider(Proximity& collider, const PluginTable& table)
        : collider_(collider), table_(table) {}
    ~WatchedCollider();

    Status add(std::uint32_t body, const ShapePlacement& placement) noexcept override;
    Status remove(std::uint32_t body) noexcept override;
    Status exclude(std::uint32_t a, std::uint32_t b, bool excluded) noexcept override;
    Status detect(const DetectRequest& request, const ContactSink* sinks,
                  std::uint32_t sink_count) noexcept override;
    DetectStats stats() const noexcept override { return stats_; }
    Status cast_rays(const RayRequest* rays, RayHit* hits, std::uint32_t count) noexcept override;
    Status closest(std::uint32_t a, std::uint32_t b, Contact* result) noexcept override;
    Status detect_particles(const ParticleRequest& request, const ContactSink* sinks,
                            std::uint32_t sink_count) noexcept override;

private:
    Proximity& collider_;
    const PluginTable& table_;
    DetectStats stats_{};
};

}  // namespace plumb
