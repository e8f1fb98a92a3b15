// SPDX-License-Identifier: MIT
#include "host/source_proximity.h"

#include <algorithm>
#include <exception>

namespace plumb {
namespace {

/// Drops the contacts of pairs that the caller has already.
void leave_out(std::vector<Contact>& contacts, const PairFilter& filter) {
    std::vector<CandidatePair> pairs;
    for (const Contact& c : contacts)
        if (pairs.empty() || pairs.back().a != c.a || pairs.back().b != c.b)
            pairs.push_back({c.a, c.b});
    std::vector<std::uint8_t> wanted(pairs.size(), 1);
    filter.choose(filter.ctx, pairs.data(), static_cast<std::uint32_t>(pairs.size()),
                  wanted.data());
    std::size_t pair = 0;
    std::erase_if(contacts, [&](const Contact& c) {
        while (pairs[pair].a != c.a || pairs[pair].b != c.b) ++pair;
        return wanted[pair] == 0;
    });
}

}  // namespace

Status SourceProximity::remove(std::uint32_t) noexcept {
    return {Status::unsupported, 0, "a collider in another process keeps its bodies"};
}

Status SourceProximity::known() const {
    if (!asked_) return ok_status();
    return {Status::unsupported, 0, "a collider in another process keeps its bodies and pairs"};
}

Status SourceProximity::detect(const DetectRequest& request, const ContactSink* sinks,
                               std::uint32_t sink_count) noexcept {
    if (!sinks || sink_count == 0) return {Status::bad_argument, 0, "detect needs a sink"};
    asked_ = true;
    try {
        return ask(request, sinks[0]);
    } catch (const std::exception& e) {
        try {
            trouble_ = e.what();
        } catch (...) {
            return {Status::out_of_memory, 0, "memory ran out"};
        }
        return {Status::failed, 0, trouble_.c_str()};
    }
}

Status SourceProximity::ask(const DetectRequest& request, const ContactSink& sink) {
    poses_.assign(request.poses, request.poses + request.body_count);
    ContactAnswer answer =
        source_.ask({poses_, request.margin, (request.flags & kDetectRaw) != 0, request.sweeps});
    stats_ = answer.stats;
    if (request.filter) leave_out(answer.contacts, *request.filter);
    if (!answer.contacts.empty()) {
        Contact* room = sink.grow(sink.ctx, static_cast<std::uint32_t>(answer.contacts.size()));
        if (!room) return {Status::out_of_memory, 0, "the sink takes no more contacts"};
        std::copy(answer.contacts.begin(), answer.contacts.end(), room);
    }
    if (answer.trouble.empty()) return ok_status();
    trouble_ = answer.trouble;
    return {Status::failed, 1, trouble_.c_str()};
}

}  // namespace plumb
