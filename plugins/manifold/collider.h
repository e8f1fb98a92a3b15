// SPDX-License-Identifier: MIT
/// What every plugin's collider does alike: keep the table of bodies, run broad and narrow phase,
/// hand over contacts, and let no exception out. A plugin adds its broad phase, its narrow phase
/// and whatever it hangs on a part.
#pragma once

#include "manifold/candidates.h"
#include "manifold/closest.h"
#include "manifold/manifold.h"
#include "manifold/queries.h"

namespace plumb {

/// Which kinds of shape a plugin takes, and what it says to the others.
struct Supported {
    bool kind[kShapeKindCount];
    const char* refusal;
};

/// Where the narrow phase of one worker puts what it finds.
struct NarrowOutput {
    ContactList& contacts;
    DetectStats& stats;
    std::uint32_t& failures;  ///< pairs that the back-end failed on
};

class Collider : public Proximity {
public:
    /// `threads`: how many blocks of the narrow phase may run at once.
    Collider(const Supported& supported, std::uint32_t threads)
        : supported_(supported), threads_(std::max(threads, 1u)) {}
    virtual ~Collider() = default;

    Status add(std::uint32_t body, const ShapePlacement& placement) noexcept final;
    Status remove(std::uint32_t body) noexcept final;
    Status exclude(std::uint32_t a, std::uint32_t b, bool excluded) noexcept final;
    Status detect(const DetectRequest& request, const ContactSink* sinks,
                  std::uint32_t sink_count) noexcept final;
    DetectStats stats() const noexcept final { return stats_; }
    Status detect_particles(const ParticleRequest& request, const ContactSink* sinks,
                            std::uint32_t sink_count) noexcept final;
    Status cast_rays(const RayRequest* rays, RayHit* hits, std::uint32_t count) noexcept final;
    Status closest(std::uint32_t body_a, std::uint32_t body_b, Contact* result) noexcept final;

protected:
    /// Called once for each new part, before it is first placed.
    virtual void prepare(Part& part) { (void)part; }

    /// Fills `pairs` with the candidates: fat bounds overlap, and the table wants them. Any order.
    /// Called only when many parts came or left their fat bounds.
    virtual void find_pairs(std::vector<PartPair>& pairs) = 0;

    /// Called before blocks of these pairs, whose parts have their world frames: brings what the
    /// plugin hangs on them there.
    virtual void place_parts(const PartPair* pairs, std::size_t count) { (void)pairs, (void)count; }
    /// Calls place(part) for the parts of pairs, each once. They lie far apart in memory, which is
    /// asked for ahead.
    template <class Place>
    void each_part(const PartPair* pairs, std::size_t count, Place place) {
        constexpr std::size_t kPartAhead = 8, kBackendAhead = 4;
        list_parts(pairs, count);
        for (std::size_t k = 0; k < named_.size(); ++k) {
            if (k + kPartAhead < named_.size()) {
                const Part& part = *named_[k + kPartAhead];
                __builtin_prefetch(&part.backend), __builtin_prefetch(&part.world);
            }
            if (k + kBackendAhead < named_.size())
                __builtin_prefetch(named_[k + kBackendAhead]->backend.get());
            place(*named_[k]);
        }
    }

    /// Whether the narrow phase sees even balls that a closed form tells to be far: where it shall
    /// share nothing with the others.
    virtual bool sees_far_balls() const { return false; }

    /// Adds the contacts of some pairs, which stand sorted. `raw`: what the back-end itself says.
    /// Blocks run on several threads at once; what is written to must belong to the worker.
    virtual void collide_block(const NarrowOutput& out, const PartPair* pairs, std::size_t count,
                               bool raw, std::uint32_t worker) = 0;

    std::uint32_t threads() const { return threads_; }

    BodyTable table_;

private:
    /// The share of one worker.
    struct Block {
        ContactList contacts;
        DetectStats stats;
        std::uint32_t failures;
        Status status;
    };

    Status detect_all(const DetectRequest& request, const ContactSink* sinks,
                      std::uint32_t sink_count);
    void run_blocks(const DetectRequest& request, std::uint32_t count);
    void run_block(std::uint32_t index, bool raw, const PartPair* pairs,
                   std::size_t count) noexcept;
    void list_parts(const PartPair* pairs, std::size_t count);
    Status gather(const ContactSink* sinks);
    Status closest_of_bodies(BodyTable::Range a, BodyTable::Range b, Contact& result);
    Closeness closest_of_pair(Contact& result, const PartPair& pair);
    bool deepest_of_pair(Contact& result, const PartPair& pair);

    const Supported& supported_;
    std::uint32_t threads_;
    Candidates candidates_;
    Queries queries_{table_};
    std::vector<PartPair> pairs_;
    std::vector<const Part*> named_;      ///< by the pairs, each once
    std::vector<std::uint8_t> is_named_;  ///< [part]
    std::vector<Block> blocks_;           ///< [worker]
    ContactList meeting_;                 ///< of one pair of parts that meet, for `closest`
    DetectStats stats_{};
};

}  // namespace plumb
