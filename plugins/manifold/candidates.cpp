// SPDX-License-Identifier: MIT
#include "manifold/candidates.h"

namespace plumb {
namespace {

constexpr double kSpare = 0.03;         ///< of a part's least extent, left around it everywhere
constexpr double kDetectionsAhead = 5;  ///< for which a moving part gets room

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

bool Candidates::hold(const BodyTable& table) {
    ++since_search_;
    if (version_ != table.version()) return false;
    return std::all_of(table.parts().begin(), table.parts().end(), [](const Part& p) {
        // A part that was lost may come back anywhere; its fat bounds are those of before.
        return !p.present || contains(p.fat, p.bounds);
    });
}

void Candidates::fatten(BodyTable& table) {
    const bool comparable = version_ == table.version() && since_search_ > 0;
    low_before_.resize(table.parts().size());
    for (std::size_t i = 0; i < table.parts().size(); ++i) {
        Part& part = table.parts()[i];
        if (!part.present) continue;
        double spare = kSpare * least_extent(part.bounds);
        if (comparable) {
            const Vec3 moved = part.bounds.low - low_before_[i];
            const double travel =
                std::max({std::abs(moved.x), std::abs(moved.y), std::abs(moved.z)});
            if (std::isfinite(travel)) spare += kDetectionsAhead * travel / since_search_;
        }
        if (!std::isfinite(spare)) spare = 0;  // a half-space
        const Vec3 grown{spare, spare, spare};
        part.fat = {part.bounds.low - grown, part.bounds.high + grown};
        low_before_[i] = part.bounds.low;
    }
    version_ = table.version();
    since_search_ = 0;
}

void Candidates::take_overlapping(std::vector<PartPair>& near, const BodyTable& table) const {
    const std::vector<Part>& parts = table.parts();
    near.clear();
    for (const PartPair& pair : wide_) {
        const Part &a = parts[pair.first], &b = parts[pair.second];
        if (a.present && b.present && overlap(a.bounds, b.bounds)) near.push_back(pair);
    }
}

void Candidates::apply(const PairFilter& filter, std::vector<PartPair>& pairs,
                       const BodyTable& table) {
    const auto ids = [&](const PartPair& p) {
        return CandidatePair{table.parts()[p.first].body, table.parts()[p.second].body};
    };
    const auto same = [](const CandidatePair& p, const CandidatePair& q) { return p.a == q.a && p.b == q.b; };
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
