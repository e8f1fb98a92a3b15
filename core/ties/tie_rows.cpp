// SPDX-License-Identifier: MIT
#include "ties/tie_rows.h"

#include <algorithm>

namespace plumb {
namespace {

template <class Of>
double worst_of(const TieRange::Part& part, Of of) {
    double worst = 0;
    for (std::uint32_t i = part.first; i < part.last; ++i) worst = std::max(worst, of(i));
    return worst;
}

}  // namespace

void TieRows::clear() { joints_.clear(), links_.clear(), couplings_.clear(), rows_.clear(); }

void TieRows::begin_range(TieRange& range) const {
    range.joints.first = joints_.size();
    range.links.first = links_.size();
    range.couplings.first = couplings_.size();
}

void TieRows::end_range(TieRange& range) const {
    range.joints.last = joints_.size();
    range.links.last = links_.size();
    range.couplings.last = couplings_.size();
}

void TieRows::add(const World& world, const Tie& tie, const TiedBodies& at) {
    switch (tie.kind) {
        case TieKind::joint:
            return joints_.add(world, tie.index, at);
        case TieKind::link:
            return links_.add(tie.index, at);
        case TieKind::coupling:
            return couplings_.add(world, tie.index, at);
    }
}

Tie TieRows::first_of(const TieRange& range) const {
    if (range.joints.first < range.joints.last)
        return {TieKind::joint, joints_.joint(range.joints.first)};
    if (range.links.first < range.links.last)
        return {TieKind::link, links_.link(range.links.first)};
    return {TieKind::coupling, couplings_.coupling(range.couplings.first)};
}

void TieRows::begin(const World& world, const SubstepTime& time, TieRange& range) {
    h_ = time.h;
    range.first_row = static_cast<std::uint32_t>(rows_.size());
    const auto begin_each = [&](auto& kind, const TieRange::Part& part) {
        for (std::uint32_t i = part.first; i < part.last; ++i) kind.begin(world, time, i, rows_);
    };
    begin_each(joints_, range.joints);
    begin_each(links_, range.links);
    begin_each(couplings_, range.couplings);
    range.last_row = static_cast<std::uint32_t>(rows_.size());
}

double TieRows::open_at_start(const TieRange& range) const {
    return worst_of(range.joints, [&](std::uint32_t i) { return joints_.open_at_start(i); });
}

double TieRows::open_at_end(const TieRange& range, std::span<const Vector6d> velocity) const {
    return worst_of(range.joints,
                    [&](std::uint32_t i) { return joints_.open_at_end(i, velocity, h_); });
}

double TieRows::scripted_speed(const TieRange& range) const {
    return std::max(
        worst_of(range.joints, [&](std::uint32_t i) { return joints_.scripted_speed(i); }),
        worst_of(range.links, [&](std::uint32_t i) { return links_.scripted_speed(i); }));
}

double TieRows::ask_to_close(const TieRange& range, std::span<const Vector6d> velocity,
                             OldErrors old) {
    double worst = 0;
    for (std::uint32_t i = range.joints.first; i < range.joints.last; ++i)
        worst = std::max(worst, joints_.ask(i, velocity, h_, old, rows_));
    for (std::uint32_t i = range.links.first; i < range.links.last; ++i)
        worst = std::max(worst, links_.ask(i, velocity, h_, rows_));
    return worst;
}

double TieRows::ask(const TieRange& range, std::span<const Vector6d> velocity, OldErrors old) {
    double worst = ask_to_close(range, velocity, old);
    for (std::uint32_t i = range.couplings.first; i < range.couplings.last; ++i)
        worst = std::max(worst, couplings_.ask(i, velocity, h_, rows_));
    return worst;
}

void TieRows::store_impulses(const TieRange& range, std::span<const Vector6d> velocity,
                             World& world) const {
    for (std::uint32_t i = range.joints.first; i < range.joints.last; ++i)
        joints_.store_impulses(i, velocity, rows_, world.joints);
    for (std::uint32_t i = range.links.first; i < range.links.last; ++i)
        links_.store_impulses(i, rows_, world.links);
    for (std::uint32_t i = range.couplings.first; i < range.couplings.last; ++i)
        couplings_.store_impulses(i, rows_, world.joints.couplings);
}

}  // namespace plumb
