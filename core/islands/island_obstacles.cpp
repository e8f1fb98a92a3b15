// SPDX-License-Identifier: MIT
#include "islands/island_obstacles.h"

#include "constraints/substep_time.h"
#include "ties/tie_load.h"

namespace plumb {
namespace {

/// How far joints may turn within a substep [rad], also where others are worse at it, and the
/// square of h ω of what they pull.
constexpr double kFarTurn = 0.2, kFarthestTurn = 1, kHardPull = 2;

/// What hangs under a hard pull is at rest where its joints turn by no more than this [rad].
constexpr double kRestingTurn = 0.005;

}  // namespace

void IslandObstacles::find(const World& world, const std::vector<Tie>& ties,
                           const SolvedTies& solved) {
    marks_.assign(static_cast<std::size_t>(world.dynamic_count), 0);
    const auto mark = [&](const Tie& tie, std::uint8_t obstacle) {
        each_body(world, tie, [&](std::uint32_t body) { put(world, body, obstacle); });
    };
    world.each_body_among_particles([&](std::uint32_t body) { put(world, body, kBeyond); });
    const double h = substep_of(world.settings);
    const bool iterated = world.settings.joints == JointMethod::iterate;
    for (const Tie& tie : ties) {
        if (solved.has(tie)) mark(tie, kBeyond);
        if (tie.kind == TieKind::coupling) continue;
        const bool is_joint = tie.kind == TieKind::joint;
        const TieLoad load = is_joint ? load_of(world, world.joints.joints[tie.index], h)
                                      : load_of(world, world.links[tie.index], h);
        if (is_joint && iterated) mark(tie, kBeyond);
        const bool rests = is_joint && load.turn <= kRestingTurn;
        if (load.pull > kHardPull) mark(tie, rests ? kPulled : kHard);
        if (load.turn > kFarthestTurn) mark(tie, kHard);
        if (load.turn > kFarTurn) mark(tie, kFast);
        if (rest_of(world, tie).steps > 0) mark(tie, kRests);
    }
}

void IslandObstacles::put(const World& world, std::uint32_t body, std::uint8_t obstacle) {
    if (body != kNoIndex && world.bodies.motion[body] == Motion::dynamic)
        marks_[world.bodies.row[body]] |= obstacle;
}

std::uint8_t IslandObstacles::of(const ContactIslands& found, const ContactIsland& island) const {
    std::uint8_t all = 0;
    for (std::uint32_t i = island.first_body; i < island.last_body; ++i)
        all |= marks_[found.bodies()[i]];
    return all;
}

}  // namespace plumb
