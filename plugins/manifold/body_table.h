// SPDX-License-Identifier: MIT
/// The bodies of a collider: shapes, filters, exclusions, and where each part is at the moment.
///
/// Every plugin keeps one. A compound is taken apart on the way in, so that a narrow phase meets
/// single shapes only; parts stand in the order of (body id, part), which makes i < j mean "a
/// before b". The parts of a body that was removed leave vacant places, which the next body of its
/// id takes: most often the others stay where they are.
#pragma once

#include "manifold/hull_faces.h"
#include "manifold/surface.h"

#include <plumb/plugin.h>

#include <cstdint>
#include <memory>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace plumb {

/// One single shape of a body.
struct Part {
    std::uint32_t body = 0;
    bool vacant = false;      ///< a place that was left: its body is not here
    std::uint32_t index = 0;  ///< in its compound; else 0
    bool in_compound = false;
    Shape shape{};
    Frame local{};                ///< shape frame → body frame
    std::vector<HullFace> faces;  ///< hulls only
    Aabb own_bounds{};  ///< of the vertices, in the shape's frame (hull, mesh, height field but not
                        ///< what is below)
    double half_width = 0;  ///< half the least width of a convex shape, or a little less [m]
    std::shared_ptr<const Surface> surface;  ///< mesh and height field only
    std::shared_ptr<void> backend;           ///< whatever the plugin hangs on it

    Frame world{};         ///< shape frame → world, at the poses of the last `place`
    Aabb bounds{};         ///< world, grown by half the margin and the sweep
    Aabb fat = kNothing;   ///< contains `bounds`; what a broad phase works on. Nothing where
                           ///< all of the part's pairs are to be found anew
    double expansion = 0;  ///< of its bounds: half the margin and the sweep [m]
    bool present = false;  ///< has a pose, and a finite one
    std::uint32_t group = 0, mask = 0;
    bool dynamic = false, has_exclusions = false;
};

/// Two parts, as indices into BodyTable::parts(), first < second.
struct PartPair {
    std::uint32_t first, second;
};

class BodyTable {
public:
    /// Adds a body whose kinds of shape are all marked in `supported` (indexed by kind).
    Status add(std::uint32_t body, const ShapePlacement& placement,
               const bool (&supported)[kShapeKindCount], const char* refusal);
    Status remove(std::uint32_t body);
    Status exclude(std::uint32_t a, std::uint32_t b, bool excluded);

    /// Moves every part to the pose of its body. Answers `failed` where poses were missing or not
    /// finite; such bodies are absent until the next call.
    Status place(const DetectRequest& request);

    std::vector<Part>& parts() { return parts_; }
    const std::vector<Part>& parts() const { return parts_; }

    /// The parts of a body, as indices from first to before last: none of a body that is not here.
    struct Range {
        std::uint32_t first, last;
    };
    Range parts_of(std::uint32_t body) const;

    /// Whether two parts are to be tested, by mobility, filters and exclusions (not by place).
    bool wanted(const Part& a, const Part& b) const;

    /// The greatest expansion of a part's bounds, at the poses of the last `place` [m].
    double greatest_expansion() const { return greatest_expansion_; }

    /// Counts changes of the set of parts.
    std::uint64_t version() const { return version_; }

    /// Counts those among them that gave parts other indices.
    std::uint64_t order() const { return order_; }

private:
    void insert(std::uint32_t body, const ShapePlacement& placement);
    Range places_of(std::uint32_t body) const;
    bool knows(std::uint32_t body) const;
    void vacate(Range places);
    void end_exclusions(std::uint32_t body);
    void count_exclusion(std::uint32_t body, int change);

    std::vector<Part> parts_;
    SurfaceStore surfaces_;
    std::unordered_set<std::uint64_t> excluded_;
    std::unordered_map<std::uint32_t, int> exclusions_;  ///< of a body that has some
    std::size_t vacant_ = 0;                             ///< places
    double greatest_expansion_ = 0;
    std::uint64_t version_ = 0, order_ = 0;
};

/// Distance up to which two parts are reported [m].
inline double pair_margin(const Part& a, const Part& b) { return a.expansion + b.expansion; }

/// By bodies, then by parts. Parts stand in the order of their bodies, so only compounds make the
/// two disagree.
struct PairOrder {
    const std::vector<std::uint32_t>& bodies;  ///< [part]
    bool operator()(const PartPair& p, const PartPair& q) const {
        const auto key = [this](const PartPair& x) {
            return std::tuple(bodies[x.first], bodies[x.second], x.first, x.second);
        };
        return key(p) < key(q);
    }
};

/// Sorts in that order: all pairs of parts of two bodies stand next to each other.
void sort_pairs(std::vector<PartPair>& pairs, const std::vector<Part>& parts);

/// Bounds of one part in some outer frame, not grown, where `f` is its shape's frame there.
Aabb bounds_at(const Part& part, const Frame& f);

/// Bounds of one part at its world frame, not grown. Half-spaces and height fields have infinite
/// ones.
inline Aabb bounds_of(const Part& part) { return bounds_at(part, part.world); }

}  // namespace plumb
