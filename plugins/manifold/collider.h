// SPDX-License-Identifier: MIT
/// What every plugin's collider does alike: keep the table of bodies, run broad and narrow phase,
/// hand over contacts, and let no exception out. A plugin adds its broad phase, its narrow phase
/// and whatever it hangs on a part.
#pragma once

#include "manifold/manifold.h"

namespace plumb {

/// Which kinds of shape a plugin takes, and what it says to the others.
struct Supported {
    bool kind[kShapeKindCount];
    const char* refusal;
};

class Collider : public Proximity {
public:
    explicit Collider(const Supported& supported) : supported_(supported) {}
    virtual ~Collider() = default;

    Status add(std::uint32_t body, const ShapePlacement& placement) noexcept final;
    Status remove(std::uint32_t body) noexcept final;
    Status exclude(std::uint32_t a, std::uint32_t b, bool excluded) noexcept final;
    Status detect(const DetectRequest& request, const ContactSink* sinks,
                  std::uint32_t sink_count) noexcept final;
    DetectStats stats() const noexcept final { return stats_; }

protected:
    /// Called once for each new part, before it is first placed.
    virtual void prepare(Part& part) { (void)part; }

    /// Fills `pairs` with the candidates: bounds overlap, and the table wants them. Any order.
    virtual void find_pairs(std::vector<PartPair>& pairs) = 0;

    /// Adds the contacts of all pairs, which stand sorted. `raw`: what the back-end itself says.
    virtual void collide_all(const std::vector<PartPair>& pairs, bool raw) = 0;

    BodyTable table_;
    ContactList contacts_;
    DetectStats stats_{};
    std::uint32_t failures_ = 0;  ///< pairs that the back-end failed on, in this `detect`

private:
    Status detect_all(const DetectRequest& request, const ContactSink* sinks,
                      std::uint32_t sink_count);

    const Supported& supported_;
    std::vector<PartPair> pairs_;
};

/// A plugin's table with everything filled in but names, pairs and functions.
PluginTable blank_table();

}  // namespace plumb
