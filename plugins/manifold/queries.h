// SPDX-License-Identifier: MIT
/// Particles and rays against all bodies, where they stood at the last detection.
///
/// One tree over the parts' bounds serves both; it is made when the first question after a
/// detection comes. Half-spaces have no bounds and are asked one by one.
#pragma once

#include "manifold/contact_list.h"
#include "manifold/ray.h"

#include <plumb/proximity.h>

namespace plumb {

class Queries {
public:
    explicit Queries(const BodyTable& table) : table_(table) {}

    /// Parts have moved.
    void forget() { known_ = false; }

    /// Uses as many sinks as there are workers, at most `threads`.
    Status detect_particles(const ParticleRequest& request, const ContactSink* sinks,
                            std::uint32_t sink_count, std::uint32_t threads);

    Status cast_rays(const RayRequest* rays, RayHit* hits, std::uint32_t count);

private:
    /// Particles of one worker and what they touch.
    struct Share {
        ContactList contacts;
        std::vector<std::uint32_t> near;  ///< parts around the particle at hand
        std::uint32_t bad;                ///< particles with impossible numbers
        Status status;
    };

    void refresh();
    void run_share(Share& share, const ParticleRequest& request, std::uint32_t first,
                   std::uint32_t last) const;
    void touch(Share& share, const ParticleRequest& request, std::uint32_t particle) const;
    RayHit first_hit(const RayRequest& request) const;

    const BodyTable& table_;
    BoxTree tree_;
    std::vector<std::uint32_t> bounded_;    ///< [item of the tree] part
    std::vector<std::uint32_t> unbounded_;  ///< parts
    std::vector<Share> shares_;             ///< [worker]
    bool known_ = false;
    std::uint64_t version_ = 0;
};

}  // namespace plumb
