// SPDX-License-Identifier: MIT
/// Closest contact of two bodies: the best of their parts, each pair at any distance. Where parts
/// meet, the plugin's own narrow phase says how deep.
#include "manifold/collider.h"
#include "manifold/guarded.h"
#include "manifold/support.h"

namespace plumb {

Status Collider::closest(std::uint32_t body_a, std::uint32_t body_b, Contact* result) noexcept {
    return guarded([&] {
        if (!result) return Status{Status::bad_argument, 0, "closest needs room for its answer"};
        if (body_a == body_b) return Status{Status::bad_argument, 0, "the two bodies are one"};
        const auto a = table_.parts_of(std::min(body_a, body_b));
        const auto b = table_.parts_of(std::max(body_a, body_b));
        if (a.first == a.last || b.first == b.last)
            return Status{Status::bad_argument, 0, "one of the two bodies is unknown"};
        if (!table_.parts()[a.first].present || !table_.parts()[b.first].present)
            return Status{Status::bad_argument, 0,
                          "the last detection had no finite pose for one of the two bodies"};
        return closest_of_bodies(a, b, *result);
    });
}

Status Collider::closest_of_bodies(BodyTable::Range a, BodyTable::Range b, Contact& result) {
    Contact best{}, next{};
    best.gap = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = a.first; i < a.last; ++i)
        for (std::uint32_t k = b.first; k < b.last; ++k) {
            const double reach = std::max(best.gap, 0.0);
            const double apart =
                squared_distance(bounds_of(table_.parts()[i]), bounds_of(table_.parts()[k]));
            if (apart > reach * reach) continue;
            const Closeness answer = closest_of_pair(next, {i, k});
            if (answer == Closeness::meet)
                return {Status::failed, 1,
                        "the two bodies meet where the back-end has no contact of their shapes"};
            if (answer == Closeness::found && next.gap < best.gap) best = next;
        }
    if (!std::isfinite(best.gap))
        return {Status::unsupported, 0, "two half-spaces have no closest points"};
    result = best;
    return ok_status();
}

Closeness Collider::closest_of_pair(Contact& result, const PartPair& pair) {
    const Part &a = table_.parts()[pair.first], &b = table_.parts()[pair.second];
    const Closeness answer = closest_of_parts(result, a, b);
    if (answer != Closeness::meet) return answer;
    const bool found = deepest_of_pair(result, pair) || closest_of_smaller(result, a, b);
    return found ? Closeness::found : Closeness::meet;
}

/// Up to a gap that is none but for rounding: a back-end may find the least of one where parts
/// meet.
bool Collider::deepest_of_pair(Contact& result, const PartPair& pair) {
    constexpr double kRounding = 1e-9;  // of the sizes
    place_parts(&pair, 1);
    double& expansion = table_.parts()[pair.first].expansion;
    const double before = expansion;
    const double sizes = size_of(table_.parts()[pair.first]) + size_of(table_.parts()[pair.second]);
    expansion += kRounding * sizes;
    DetectStats stats{};
    std::uint32_t failures = 0;
    meeting_.clear();
    collide_block({meeting_, stats, failures}, &pair, 1, false, 0);
    expansion = before;
    meeting_.finish();
    if (meeting_.size() == 0) return false;
    result = *std::min_element(meeting_.begin(), meeting_.end(),
                               [](const Contact& p, const Contact& q) { return p.gap < q.gap; });
    return true;
}

}  // namespace plumb
