// SPDX-License-Identifier: MIT
#include "step/island_ties.h"

#include <algorithm>

namespace plumb {
namespace {

template <class Of>
double worst_of(const IslandTieRange::Part& part, Of of) {
    double worst = 0;
    for (std::uint32_t i = part.first; i < part.last; ++i) worst = std::max(worst, of(i));
    return worst;
}

}  // namespace

void IslandTies::clear() { joints_.clear(), links_.clear(), couplings_.clear(), rows_.clear(); }

void IslandTies::begin_island(IslandTieRange& range) const {
    range.joints.first = joints_.size();
    range.links.first = links_.size();
    range.couplings.first = couplings_.size();
}

void IslandTies::end_island(IslandTieRange& range) const {
    range.joints.last = joints_.size();
    range.links.last = links_.size();
    range.couplings.last = couplings_.size();
}

void IslandTies::add(const World& world, const ContactIslands& islands, const Tie& tie) {
    switch (tie.kind) {
        case TieKind::joint:
            return joints_.add(world, islands, tie.index);
        case TieKind::link:
            return links_.add(world, islands, tie.index);
        case TieKind::coupling:
            return couplings_.add(world, islands, tie.index);
    }
}

Tie IslandTies::first_of(const IslandTieRange& range) const {
    if (range.joints.first < range.joints.last)
        return {TieKind::joint, joints_.joint(range.joints.first)};
    if (range.links.first < range.links.last)
        return {TieKind::link, links_.link(range.links.first)};
    return {TieKind::coupling, couplings_.coupling(range.couplings.first)};
}

void IslandTies::begin(const World& world, const SubstepTime& time, IslandTieRange& range) {
    h_ = time.h;
    range.first_row = static_cast<std::uint32_t>(rows_.size());
    const auto begin_each = [&](auto& kind, const IslandTieRange::Part& part) {
        for (std::uint32_t i = part.first; i < part.last; ++i) kind.begin(world, time, i, rows_);
    };
    begin_each(joints_, range.joints);
    begin_each(links_, range.links);
    begin_each(couplings_, range.couplings);
    range.last_row = static_cast<std::uint32_t>(rows_.size());
}

double IslandTies::open_at_start(const IslandTieRange& range) const {
    return worst_of(range.joints, [&](std::uint32_t i) { return joints_.open_at_start(i); });
}

double IslandTies::open_at_end(const IslandTieRange& range,
                               std::span<const Vector6d> velocity) const {
    return worst_of(range.joints,
                    [&](std::uint32_t i) { return joints_.open_at_end(i, velocity, h_); });
}

double IslandTies::scripted_speed(const IslandTieRange& range) const {
    return worst_of(range.joints, [&](std::uint32_t i) { return joints_.scripted_speed(i); });
}

double IslandTies::ask_to_close(const IslandTieRange& range, std::span<const Vector6d> velocity,
                                OldErrors old) {
    double worst = 0;
    for (std::uint32_t i = range.joints.first; i < range.joints.last; ++i)
        worst = std::max(worst, joints_.ask(i, velocity, h_, old, rows_));
    for (std::uint32_t i = range.links.first; i < range.links.last; ++i)
        worst = std::max(worst, links_.ask(i, velocity, h_, rows_));
    return worst;
}

double IslandTies::ask(const IslandTieRange& range, std::span<const Vector6d> velocity,
                       OldErrors old) {
    double worst = ask_to_close(range, velocity, old);
    for (std::uint32_t i = range.couplings.first; i < range.couplings.last; ++i)
        worst = std::max(worst, couplings_.ask(i, velocity, h_, rows_));
    return worst;
}

void IslandTies::store_impulses(const IslandTieRange& range, std::span<const Vector6d> velocity,
                                World& world) const {
    for (std::uint32_t i = range.joints.first; i < range.joints.last; ++i)
        joints_.store_impulses(i, velocity, rows_, world.joints);
    for (std::uint32_t i = range.links.first; i < range.links.last; ++i)
        links_.store_impulses(i, rows_, world.links);
    for (std::uint32_t i = range.couplings.first; i < range.couplings.last; ++i)
        couplings_.store_impulses(i, rows_, world.joints.couplings);
}

}  // namespace plumb
