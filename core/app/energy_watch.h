// SPDX-License-Identifier: MIT
/// Tells a run whose energy runs away from one that is healthy.
#pragma once

#include "effects/report.h"
#include "world/world.h"

namespace plumb::app {

/// Motion and height may have the energy that the run began with, plus a tenth of what could be
/// turned over so far (start less the lowest potential), plus what the pushing out of overlap has
/// given. What deforms may store energy, which is not counted. Scenes where kinematic bodies,
/// constant torques, wind, motors, springs, links that begin stretched, or balloons that are pumped
/// up do work are not watched, since that work is not counted.
class EnergyWatch {
public:
    explicit EnergyWatch(const World& world);

    void add(const World& world, const StepReport& report);

    /// Ten steps in a row above what may be.
    bool ran_away() const { return steps_above_ >= 10; }
    double start() const { return start_; }  ///< [J]

private:
    /// Most that pushing out overlap can give in one step [J].
    double push_limit(const World& world, const StepReport& report) const;

    double start_, last_, lowest_potential_;  ///< [J]
    double mass_ = 0;                         ///< of all dynamic bodies [kg]
    double slack_ = 0;                        ///< for overlap too shallow to be clamped [J]
    double pushed_ = 0;                       ///< gained while deep overlap was pushed out [J]
    bool watches_;
    int steps_above_ = 0;
};

}  // namespace plumb::app
