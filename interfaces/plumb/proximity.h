// SPDX-License-Identifier: MIT
/// The abstract collider: all that the solver knows about collision detection.
///
/// An embedder derives from `Proximity` and hands the object to the core; a plugin does the same
/// behind the table of plugin.h. What the core relies on:
///
///  * A collider is a pure function of shapes and poses. It keeps acceleration structures, never
///  histories: asked
///    twice with the same poses it answers the same, whatever was asked between.
///  * Every pair whose gap is at most the margin is reported, with as many points as its touching
///  area needs (a box
///    on a plane: four). The margin is a distance of detection, never a thickness.
///  * A pair is ordered a < b before its narrow phase, and contacts arrive sorted by (a, b,
///  feature).
///  * No call throws. Trouble is a status with a sentence; what was found before it stays valid.
///
/// Virtual functions are only ever appended. The host calls none beyond the minor version that a
/// plugin was built with; those that are not pure have a default that answers `unsupported`.
#pragma once

#include <plumb/contact_set.h>
#include <plumb/shape.h>

#include <cstdint>

namespace plumb {

/// Result of a call. `message` is a static or collider-owned string that lives until the next call,
/// or nullptr.
struct Status {
    enum Code : std::int32_t {
        ok = 0,
        unsupported = 1,    ///< this collider cannot do it, and will say the same next time
        bad_argument = 2,   ///< unknown body, impossible shape
        out_of_memory = 3,  ///< a sink refused to grow, or memory ran out
        failed =
            4  ///< the back-end failed on this call (a pair was left out, an exception was caught)
    };
    std::int32_t code;
    std::uint32_t count;  ///< how many pairs were affected, where that makes sense
    const char* message;
};
inline Status ok_status() noexcept { return {Status::ok, 0, nullptr}; }

/// How a body takes part. Two bodies that are both not dynamic are never tested against each other.
enum class Mobility : std::uint32_t { fixed = 0, kinematic = 1, dynamic = 2 };

/// What is added under a body id: the shape, where it sits in the body's frame, and what it may
/// touch. Two bodies are tested if (group_a & mask_b) != 0 and (group_b & mask_a) != 0, and the
/// pair is not excluded.
struct ShapePlacement {
    Shape shape;
    Pose local;  ///< shape frame → body frame
    Mobility mobility;
    std::uint32_t group;
    std::uint32_t mask;
    std::uint32_t reserved;  ///< zero
};

enum DetectFlags : std::uint32_t {
    kDetectRaw =
        1u << 0  ///< report what the back-end itself says: no shared clipping, no reduction
};

/// Two bodies, a < b.
struct CandidatePair {
    std::uint32_t a, b;
};

/// How a caller leaves out pairs whose contacts it has already. Between its broad and its narrow
/// phase the collider asks once about all candidates, sorted and each once: `choose` sets wanted[i]
/// to 1 or 0, and pairs with 0 are not reported.
struct PairFilter {
    void* ctx;
    void (*choose)(void* ctx, const CandidatePair* pairs, std::uint32_t count,
                   std::uint8_t* wanted);
};

/// The host's worker threads. `run` calls task(arg, worker) once for each worker in 0…workers − 1,
/// on threads of their own, and returns when all have returned. A task lets no exception out.
struct TaskRunner {
    void* ctx;
    std::uint32_t workers;
    void (*run)(void* ctx, void (*task)(void* arg, std::uint32_t worker), void* arg);
};

/// One question: all contacts at these poses.
struct DetectRequest {
    const Pose*
        poses;  ///< [body_count], indexed by body id; bodies that were never added are ignored
    const double* sweeps;  ///< [body_count] how far each body may move this step [m], or nullptr:
                           ///< grows the margin
    std::uint32_t body_count;
    std::uint32_t flags;  ///< DetectFlags
    double margin;        ///< every pair with gap ≤ margin (+ sweeps of both) is wanted [m]
    const PairFilter* filter = nullptr;  ///< nullptr: every pair is wanted
    const TaskRunner* runner = nullptr;  ///< nullptr: work on the calling thread
};

/// Counts that a collider keeps of its last `detect`.
struct DetectStats {
    std::uint64_t broad_pairs;     ///< candidates of the broad phase
    std::uint64_t narrow_pairs;    ///< pairs with at least one contact
    std::uint64_t from_backend;    ///< contacts that are the back-end's own
    std::uint64_t from_clip;       ///< contacts made by clipping support faces
    std::uint64_t from_fallback;   ///< contacts where clipping fell back on the back-end's witness
    std::uint64_t shared_normals;  ///< contacts whose normal is not the back-end's own: code beside
                                   ///< it found the normal where it was silent or wrong
};

/// A ray meets the bodies with (group & mask) != 0.
struct RayRequest {
    Vec3 origin;     ///< [m]
    Vec3 direction;  ///< unit
    double length;   ///< at least 0, may be infinite [m]
    std::uint32_t mask, reserved;
};

struct RayHit {
    std::uint32_t body;  ///< kNoBody when nothing was hit
    std::uint32_t part;  ///< part of a compound, triangle of a mesh; else 0
    double distance;     ///< [m]
    Vec3 normal;         ///< surface normal of the body, unit
};
inline constexpr std::uint32_t kNoBody = 0xffffffffu;

/// Particles: points with a radius, tested against every body's shape.
struct ParticleRequest {
    const Vec3* positions;  ///< [count], [m]
    const double* radii;    ///< [count], [m]
    std::uint32_t count;
    std::uint32_t flags;
    double margin;  ///< every contact with gap ≤ margin is wanted [m]

    /// Of all particles: one meets a body if (group & mask_of_body) != 0 and (group_of_body & mask)
    /// != 0.
    std::uint32_t group = ~0u, mask = ~0u;
    const TaskRunner* runner = nullptr;  ///< nullptr: work on the calling thread
};

class Proximity {
public:
    /// Adds a body under an id that is not in use. Ids are small integers chosen by the core.
    virtual Status add(std::uint32_t body, const ShapePlacement& placement) noexcept = 0;

    /// Removes a body; afterwards its shape's memory may be freed. Its exclusions end with it, so
    /// that the id may be given to another body.
    virtual Status remove(std::uint32_t body) noexcept = 0;

    /// Excludes a pair from detection (bodies that a joint links), or lets it in again.
    virtual Status exclude(std::uint32_t body_a, std::uint32_t body_b, bool excluded) noexcept = 0;

    /// Finds the contacts at the given poses. `sinks` has one sink a worker that the collider may
    /// use; a collider that works on one thread fills sinks[0]. Each sink's contacts are sorted,
    /// and all of sinks[i] stand before those of sinks[i + 1].
    virtual Status detect(const DetectRequest& request, const ContactSink* sinks,
                          std::uint32_t sink_count) noexcept = 0;

    virtual DetectStats stats() const noexcept = 0;

    /// Nearest hit of each ray at the poses of the last `detect`. A ray that begins inside a solid
    /// hits it at distance 0 with the normal −direction; a mesh that is not closed has no inside
    /// and is hit from both sides. Rays with bad numbers hit nothing and are counted in the status.
    virtual Status cast_rays(const RayRequest* rays, RayHit* hits, std::uint32_t count) noexcept {
        (void)rays, (void)hits, (void)count;
        return {Status::unsupported, 0, "this collider casts no rays"};
    }

    /// Deepest or nearest contact of two bodies at any distance, at the poses of the last `detect`,
    /// with the body of the lower id as a. Filters do not matter.
    virtual Status closest(std::uint32_t body_a, std::uint32_t body_b, Contact* result) noexcept {
        (void)body_a, (void)body_b, (void)result;
        return {Status::unsupported, 0, "this collider has no closest points"};
    }

    /// Contacts of particles with bodies, at the poses of the last `detect`: `a` is the particle's
    /// index and `b` the body, with one contact for each part of it; sorted, and spread over the
    /// sinks, as in `detect`. Particles with bad numbers are left out and counted in the status.
    virtual Status detect_particles(const ParticleRequest& request, const ContactSink* sinks,
                                    std::uint32_t sink_count) noexcept {
        (void)request, (void)sinks, (void)sink_count;
        return {Status::unsupported, 0, "this collider tests no particles"};
    }

protected:
    Proximity() = default;
    Proximity(const Proximity&) = default;
    Proximity& operator=(const Proximity&) = default;
    ~Proximity() =
        default;  ///< not virtual: an object is destroyed by who made it (for a plugin: its table)
};

}  // namespace plumb
