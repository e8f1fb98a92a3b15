// SPDX-License-Identifier: MIT
/// What falls asleep and what wakes, at the start of a step (world/sleep.h).
///
/// Bodies that touch one another, or that joints and couplings hold together, fall asleep once each
/// of them has been slower than Settings::sleep_speed, at all its points, for Settings::sleep_time,
/// and slower than a tenth of it on the mean of each fifth of that time, while nothing pushed it.
/// What touches or is joined to what is moved along, touches or is linked to what deforms, has a
/// link, or a motor whose target follows a script, stays awake with all that it touches.
///
/// They wake as soon as something touches one of them, or moves so near that it may in the step.
/// A blow goes through all that touch one another within a step, also through what is awake, and
/// wakes them before it is solved.
#pragma once

#include "contacts/reuse_contacts.h"
#include "schedule/contact_islands.h"
#include "world/world.h"

#include <cstdint>
#include <vector>

namespace plumb {

class Sleeping {
public:
    /// Before contacts are detected. Returns whether anything fell asleep; rows are then out of
    /// date (assign_rows).
    bool let_sleep(World& world);

    /// Once contacts are known; `motions` [body] as they were detected by. Returns whether anything
    /// woke; the same.
    bool wake_disturbed(World& world, const std::vector<BodyMotion>& motions);

    std::uint32_t asleep() const { return asleep_; }  ///< bodies, at the end of the last call

private:
    void count_rest(World& world);
    void find_what_stirs(World& world, double since);
    void find_pairs(const World& world);
    void find_ties(const World& world);
    bool put_to_sleep_what_rests(World& world);
    bool find_blows(const World& world, const std::vector<BodyMotion>& motions);
    void spread_blows(const World& world);
    bool is_disturbed(const World& world, const ContactPair& pair,
                      const std::vector<BodyMotion>& motions) const;

    std::uint32_t asleep_ = 0;
    std::vector<std::uint8_t> stirs_;     // [dynamic row] whether it keeps its island awake
    std::vector<BodyPair> pairs_, ties_;  // that touch; that are held together
    ContactIslands islands_;
    std::vector<std::uint32_t> island_;
    std::vector<std::uint8_t> is_struck_;  // [body]; of what fell asleep together, the first
    double reach_ = 0;                     // gap through which a blow goes [m]
};

}  // namespace plumb
