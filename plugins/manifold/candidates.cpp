// SPDX-License-Identifier: MIT
#include "manifold/candidates.h"

#include <limits>

namespace plumb {
namespace {

constexpr double kSpare = 0.03;         ///< of a part's least extent, left around it everywhere
constexpr double kDetectionsAhead = 8;  ///< for which a moving part gets room

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Aabb kNothing{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

bool contains(const Aabb& outer, const Aabb& inner) {
    return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && outer.low.z <= inner.low.z &&
           inner.high.x <= outer.high.x && inner.high.y <= outer.high.y &&
           inner.high.z <= outer.high.z;
}

double least_extent(const Aabb& b) {
    const Vec3 d = b.high - b.low;
    return std::min({d.x, d.y, d.z});
}

}  // namespace

void Candidates::find_escaped(BodyTable& table) {
    ++detection_;
    escaped_.clear();
    std::vector<Part>& parts = table.parts();
    places_.resize(parts.size());
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        Part& part = parts[i];
        places_[i] = {part.present ? part.bounds : kNothing, part.body};
        // A part that is lost may come back anywhere, and then counts as escaped.
        if (!part.present)
            part.fat = kNothing;
        else if (!contains(part.fat, part.bounds))
            escaped_.push_back(i);
    }
}

void Candidates::fatten(Part& part, Made& made) const {
    double spare = kSpare * least_extent(part.bounds);
    const Vec3 moved = part.bounds.low - made.low;
    const double travel = std::max({std::abs(moved.x), std::abs(moved.y), std::abs(moved.z)});
    const auto detections = static_cast<double>(detection_ - made.detection);
    if (made.detection > 0) spare += kDetectionsAhead * travel / detections;
    if (!std::isfinite(spare)) spare = 0;  // a half-space
    const Vec3 grown{spare, spare, spare};
    part.fat = {part.bounds.low - grown, part.bounds.high + grown};
    made = {part.bounds.low, detection_};
}

void Candidates::fatten_all(BodyTable& table) {
    if (version_ != table.version()) made_.assign(table.parts().size(), Made{});
    for (std::size_t i = 0; i < table.parts().size(); ++i) {
        Part& part = table.parts()[i];
        if (part.present) fatten(part, made_[i]);
    }
    version_ = table.version();
}

void Candidates::renew_escaped(BodyTable& table) {
    std::vector<Part>& parts = table.parts();
    is_escaped_.assign(parts.size(), 0);
    escaped_fat_.clear();
    for (std::uint32_t i : escaped_) {
        fatten(parts[i], made_[i]);
        is_escaped_[i] = 1;
        escaped_fat_.push_back(parts[i].fat);
    }
    std::erase_if(wide_,
                  [&](const PartPair& p) { return is_escaped_[p.first] || is_escaped_[p.second]; });

    renewed_.clear();
    for (std::uint32_t j = 0; j < parts.size(); ++j) {
        if (!parts[j].present) continue;
        const Aabb fat = parts[j].fat;
        for (std::size_t k = 0; k < escaped_.size(); ++k) {
            const std::uint32_t i = escaped_[k];
            if (!overlap(fat, escaped_fat_[k]) || (is_escaped_[j] && j <= i)) continue;
            if (table.wanted(parts[i], parts[j]))
                renewed_.push_back({std::min(i, j), std::max(i, j)});
        }
    }
    sort_pairs(renewed_, parts);
    const auto middle = static_cast<std::ptrdiff_t>(wide_.size());
    wide_.insert(wide_.end(), renewed_.begin(), renewed_.end());
    std::inplace_merge(wide_.begin(), wide_.begin() + middle, wide_.end(), PairOrder{parts});
}

void Candidates::take_overlapping(std::vector<PartPair>& near) const {
    near.clear();
    for (const PartPair& pair : wide_)
        if (overlap(places_[pair.first].bounds, places_[pair.second].bounds)) near.push_back(pair);
}

void Candidates::apply(const PairFilter& filter, std::vector<PartPair>& pairs) {
    const auto ids = [this](const PartPair& p) {
        return CandidatePair{places_[p.first].body, places_[p.second].body};
    };
    const auto same = [](const CandidatePair& p, const CandidatePair& q) {
        return p.a == q.a && p.b == q.b;
    };
    asked_.clear();
    for (const PartPair& pair : pairs)
        if (asked_.empty() || !same(asked_.back(), ids(pair))) asked_.push_back(ids(pair));
    wanted_.assign(asked_.size(), 1);
    filter.choose(filter.ctx, asked_.data(), static_cast<std::uint32_t>(asked_.size()),
                  wanted_.data());
    std::size_t at = 0;
    std::erase_if(pairs, [&](const PartPair& pair) {
        if (!same(asked_[at], ids(pair))) ++at;
        return wanted_[at] == 0;
    });
}

}  // namespace plumb
