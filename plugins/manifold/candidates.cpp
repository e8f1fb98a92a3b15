// SPDX-License-Identifier: MIT
#include "manifold/candidates.h"

#include <tuple>

namespace plumb {
namespace {

constexpr double kSpare = 0.03;         ///< of a part's least extent, left around it everywhere
constexpr double kDetectionsAhead = 8;  ///< for which a moving part gets room where it goes

bool contains(const Aabb& outer, const Aabb& inner) {
    return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && outer.low.z <= inner.low.z &&
           inner.high.x <= outer.high.x && inner.high.y <= outer.high.y &&
           inner.high.z <= outer.high.z;
}

/// Lets bounds hold what goes so far from within them.
void stretch(Aabb& b, Vec3 way) {
    b.low = b.low + Vec3{std::min(way.x, 0.0), std::min(way.y, 0.0), std::min(way.z, 0.0)};
    b.high = b.high + Vec3{std::max(way.x, 0.0), std::max(way.y, 0.0), std::max(way.z, 0.0)};
}

double least_extent(const Aabb& b) {
    const Vec3 d = b.high - b.low;
    return std::min({d.x, d.y, d.z});
}

}  // namespace

/// Returns whether any came, went or left its fat bounds.
bool Candidates::find_escaped(BodyTable& table) {
    ++detection_;
    escaped_.clear();
    std::vector<Part>& parts = table.parts();
    const std::size_t known = fats_.size();
    is_outdated_.assign(std::max(known, parts.size()), 0);
    std::fill(is_outdated_.begin() + static_cast<std::ptrdiff_t>(parts.size()), is_outdated_.end(),
              std::uint8_t{1});
    bool any = known > parts.size();
    bounds_.resize(parts.size()), fats_.resize(parts.size(), {kNothing});
    bodies_.resize(parts.size()), made_.resize(parts.size());
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        Part& part = parts[i];
        // A part that is lost may come back anywhere, and then counts as escaped.
        if (!part.present) part.fat = kNothing;
        if (is_nothing(part.fat)) made_[i] = {};
        const bool escaped = part.present && !contains(part.fat, part.bounds);
        if (escaped) escaped_.push_back(i);
        is_outdated_[i] = escaped || (!part.present && !is_nothing(fats_[i].box));
        any |= is_outdated_[i] != 0;
        bounds_[i] = {part.present ? part.bounds : kNothing};
        fats_[i] = {part.fat};
        bodies_[i] = part.body;
    }
    return any;
}

void Candidates::fatten(Part& part, Made& made) const {
    double spare = kSpare * least_extent(part.bounds);
    if (!std::isfinite(spare)) spare = 0;  // a half-space
    const Vec3 grown{spare, spare, spare};
    part.fat = {part.bounds.low - grown, part.bounds.high + grown};
    const Vec3 moved = part.bounds.low - made.low;
    if (made.detection > 0 && std::isfinite(moved.x + moved.y + moved.z)) {
        const auto detections = static_cast<double>(detection_ - made.detection);
        stretch(part.fat, kDetectionsAhead / detections * moved);
    }
    made = {part.bounds.low, detection_};
}

void Candidates::fatten_all(BodyTable& table) {
    if (order_ != table.order()) made_.assign(table.parts().size(), Made{});
    for (std::size_t i = 0; i < table.parts().size(); ++i) {
        Part& part = table.parts()[i];
        if (part.present) fatten(part, made_[i]);
    }
    order_ = table.order();
}

/// Along x, with how far they reach up to each.
void Candidates::line_up_escaped(BodyTable& table) {
    std::vector<Part>& parts = table.parts();
    line_.clear();
    for (std::uint32_t i : escaped_) {
        fatten(parts[i], made_[i]);
        fats_[i] = {parts[i].fat};
        line_.push_back({parts[i].fat, 0, i});
    }
    std::sort(line_.begin(), line_.end(), [](const Escaped& p, const Escaped& q) {
        return std::tie(p.fat.low.x, p.part) < std::tie(q.fat.low.x, q.part);
    });
    double reach = -kInfinity;
    for (Escaped& e : line_) e.reach = reach = std::max(reach, e.fat.high.x);
}

/// Of those in line, the ones before that end too early, and those that begin too late, are not
/// looked at.
void Candidates::renew_escaped(BodyTable& table) {
    line_up_escaped(table);
    std::erase_if(
        wide_, [&](const PartPair& p) { return is_outdated_[p.first] || is_outdated_[p.second]; });

    const std::vector<Part>& parts = table.parts();
    renewed_.clear();
    for (std::uint32_t j = 0; j < parts.size(); ++j) {
        const Aabb& box = fats_[j].box;
        const auto ends_before = [](const Escaped& e, double x) { return e.reach < x; };
        for (auto e = std::lower_bound(line_.begin(), line_.end(), box.low.x, ends_before);
             e != line_.end() && e->fat.low.x <= box.high.x; ++e) {
            const std::uint32_t i = e->part;
            if (!overlap(box, e->fat) || (is_outdated_[j] && j <= i)) continue;
            if (parts[j].present && table.wanted(parts[i], parts[j]))
                renewed_.push_back({std::min(i, j), std::max(i, j)});
        }
    }
    std::sort(renewed_.begin(), renewed_.end(), PairOrder{bodies_});
    merge_renewed();
}

/// Among the others, the last first: few come, and what stands between them moves in one piece.
void Candidates::merge_renewed() {
    const auto stay = static_cast<std::ptrdiff_t>(wide_.size());
    wide_.resize(wide_.size() + renewed_.size());
    auto end = wide_.begin() + stay, to = wide_.end();
    for (auto pair = renewed_.rbegin(); pair != renewed_.rend(); ++pair) {
        const auto after = std::upper_bound(wide_.begin(), end, *pair, PairOrder{bodies_});
        to = std::move_backward(after, end, to);
        *--to = *pair;
        end = after;
    }
}

void Candidates::take_overlapping(std::vector<PartPair>& near) const {
    near.resize(wide_.size());
    std::size_t count = 0;
    for (const PartPair& pair : wide_) {
        near[count] = pair;
        count += overlap(bounds_[pair.first].box, bounds_[pair.second].box);
    }
    near.resize(count);
}

void Candidates::apply(const PairFilter& filter, std::vector<PartPair>& pairs) {
    asked_.clear(), first_.clear();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const CandidatePair ids{bodies_[pairs[i].first], bodies_[pairs[i].second]};
        if (i > 0 && asked_.back().a == ids.a && asked_.back().b == ids.b) continue;
        asked_.push_back(ids), first_.push_back(i);
    }
    first_.push_back(pairs.size());
    wanted_.assign(asked_.size(), 1);
    filter.choose(filter.ctx, asked_.data(), static_cast<std::uint32_t>(asked_.size()),
                  wanted_.data());
    auto end = pairs.begin();
    for (std::size_t k = 0; k < asked_.size(); ++k)
        if (wanted_[k])
            end = std::copy(pairs.begin() + first_[k], pairs.begin() + first_[k + 1], end);
    pairs.erase(end, pairs.end());
}

}  // namespace plumb
