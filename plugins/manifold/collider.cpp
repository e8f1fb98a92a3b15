// SPDX-License-Identifier: MIT
#include "manifold/collider.h"

#include "manifold/guarded.h"

namespace plumb {
namespace {

/// Share of the margin by which a ball must be beyond it: roundings are less.
constexpr double kBeyond = 1e-6;

/// Leaves out balls beside which a closed form sees nothing within the margin: bounds that are
/// boxes overlap at their corners, and of a back-end the answer costs ten times as much.
void leave_out_far_balls(std::vector<PartPair>& pairs, const std::vector<Part>& parts) {
    std::erase_if(pairs, [&](const PartPair& pair) {
        const Part &a = parts[pair.first], &b = parts[pair.second];
        double gap;
        Vec3 normal;
        return closed_form_gap(gap, normal, a, b) && gap > (1 + kBeyond) * pair_margin(a, b);
    });
}

}  // namespace

Status Collider::add(std::uint32_t body, const ShapePlacement& placement) noexcept {
    return guarded([&] {
        const Status added = table_.add(body, placement, supported_.kind, supported_.refusal);
        if (added.code != Status::ok) return added;
        try {
            const BodyTable::Range fresh = table_.parts_of(body);
            for (std::uint32_t i = fresh.first; i < fresh.last; ++i) prepare(table_.parts()[i]);
        } catch (...) {
            table_.remove(body);
            throw;
        }
        return added;
    });
}

Status Collider::remove(std::uint32_t body) noexcept {
    return guarded([&] { return table_.remove(body); });
}

Status Collider::exclude(std::uint32_t a, std::uint32_t b, bool excluded) noexcept {
    return guarded([&] { return table_.exclude(a, b, excluded); });
}

Status Collider::detect(const DetectRequest& request, const ContactSink* sinks,
                        std::uint32_t sink_count) noexcept {
    return guarded([&] { return detect_all(request, sinks, sink_count); });
}

Status Collider::detect_all(const DetectRequest& request, const ContactSink* sinks,
                            std::uint32_t sink_count) {
    stats_ = {};
    if (!sinks || !sink_count) return {Status::bad_argument, 0, "detect needs a sink"};
    const Status placed = table_.place(request);
    if (placed.code == Status::bad_argument) return placed;

    // A pair is put in order before its narrow phase: an answer may depend on the order of the
    // arguments.
    candidates_.find(pairs_, table_, [this](std::vector<PartPair>& found) { find_pairs(found); });
    stats_.broad_pairs = pairs_.size();
    if (request.filter) candidates_.apply(*request.filter, pairs_);
    if (!(request.flags & kDetectRaw) && !sees_far_balls())
        leave_out_far_balls(pairs_, table_.parts());
    place_parts(pairs_.data(), pairs_.size());
    queries_.forget();
    run_blocks(request,
               request.runner ? std::min({threads_, request.runner->workers, sink_count}) : 1);
    return worse_of(gather(sinks), placed);
}

Status Collider::detect_particles(const ParticleRequest& request, const ContactSink* sinks,
                                  std::uint32_t sink_count) noexcept {
    return guarded([&] { return queries_.detect_particles(request, sinks, sink_count, threads_); });
}

Status Collider::cast_rays(const RayRequest* rays, RayHit* hits, std::uint32_t count) noexcept {
    return guarded([&] { return queries_.cast_rays(rays, hits, count); });
}

void Collider::list_parts(const PartPair* pairs, std::size_t count) {
    named_.clear(), named_.reserve(table_.parts().size());
    is_named_.assign(table_.parts().size(), 0);
    for (std::size_t k = 0; k < count; ++k)
        for (const std::uint32_t i : {pairs[k].first, pairs[k].second}) {
            if (is_named_[i]) continue;
            is_named_[i] = 1;
            named_.push_back(&table_.parts()[i]);
        }
}

void Collider::run_blocks(const DetectRequest& request, std::uint32_t count) {
    // Equal shares, moved on to where the next pair of bodies begins.
    const auto begins = [this](std::size_t i) {
        const auto same_body = [this](std::uint32_t p, std::uint32_t q) {
            return table_.parts()[p].body == table_.parts()[q].body;
        };
        while (i > 0 && i < pairs_.size() && same_body(pairs_[i - 1].first, pairs_[i].first) &&
               same_body(pairs_[i - 1].second, pairs_[i].second))
            ++i;
        return i;
    };
    blocks_.resize(std::max(count, 1u));
    const bool raw = request.flags & kDetectRaw;
    auto task = [&](std::uint32_t worker) {
        if (worker >= blocks_.size()) return;
        const std::size_t first = begins(pairs_.size() * worker / blocks_.size());
        const std::size_t last = begins(pairs_.size() * (worker + 1) / blocks_.size());
        run_block(worker, raw, pairs_.data() + first, last - first);
    };
    if (blocks_.size() == 1) return task(0);
    request.runner->run(
        request.runner->ctx,
        [](void* arg, std::uint32_t worker) { (*static_cast<decltype(task)*>(arg))(worker); },
        &task);
}

void Collider::run_block(std::uint32_t index, bool raw, const PartPair* pairs,
                         std::size_t count) noexcept {
    Block& block = blocks_[index];
    block.contacts.clear();
    block.stats = {};
    block.failures = 0;
    block.status = guarded([&] {
        collide_block({block.contacts, block.stats, block.failures}, pairs, count, raw, index);
        block.contacts.finish();
        block.stats.narrow_pairs = block.contacts.pair_count();
        return ok_status();
    });
}

Status Collider::gather(const ContactSink* sinks) {
    Status status = ok_status();
    std::uint32_t failures = 0;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        const Block& block = blocks_[i];
        status = worse_of(worse_of(status, block.status), block.contacts.write_to(sinks[i]));
        failures += block.failures;
        stats_.narrow_pairs += block.stats.narrow_pairs;
        stats_.from_backend += block.stats.from_backend;
        stats_.from_clip += block.stats.from_clip;
        stats_.from_fallback += block.stats.from_fallback;
        stats_.shared_normals += block.stats.shared_normals;
    }
    if (status.code != Status::ok || !failures) return status;
    return {Status::failed, failures, "the back-end failed on a pair, which was left out"};
}

}  // namespace plumb
