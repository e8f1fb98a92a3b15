// SPDX-License-Identifier: MIT
#include "manifold/collider.h"

#include <new>

namespace plumb {
namespace {

template <class F>
Status guarded(F f) noexcept {
    try {
        return f();
    } catch (const std::bad_alloc&) {
        return {Status::out_of_memory, 0, "memory ran out"};
    } catch (...) {
        return {Status::failed, 0, "an unexpected exception was caught"};
    }
}

}  // namespace

Status Collider::add(std::uint32_t body, const ShapePlacement& placement) noexcept {
    return guarded([&] {
        const Status added = table_.add(body, placement, supported_.kind, supported_.refusal);
        if (added.code != Status::ok) return added;
        try {
            for (Part& part : table_.parts())
                if (part.body == body) prepare(part);
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
    failures_ = 0;
    contacts_.clear();
    pairs_.clear();
    const Status placed = table_.place(request);
    if (placed.code == Status::bad_argument) return placed;

    // A pair is put in order before its narrow phase: an answer may depend on the order of the
    // arguments.
    find_pairs(pairs_);
    sort_pairs(pairs_, table_.parts().size());
    collide_all(pairs_, request.flags & kDetectRaw);
    contacts_.finish();

    stats_.broad_pairs = pairs_.size();
    stats_.narrow_pairs = contacts_.pair_count();
    const Status written = contacts_.write_to(sinks, sink_count);
    if (written.code != Status::ok) return written;
    if (failures_)
        return {Status::failed, failures_, "the back-end failed on a pair, which was left out"};
    return placed;
}

PluginTable blank_table() {
    PluginTable t{};
    t.magic = kPluginMagic;
    t.abi_major = kAbiMajor;
    t.abi_minor = kAbiMinor;
    t.table_size = sizeof(PluginTable);
    t.sizes = abi_sizes();
    t.precision = "double";
    return t;
}

}  // namespace plumb
