// SPDX-License-Identifier: MIT
/// Which joints of a run came apart, by how much and when.
#pragma once

#include "effects/report.h"
#include "scene/scene.h"
#include "world/world.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace plumb::app {

/// The worst of each step that has any, of joints or couplings.
class ErrorWatch {
public:
    struct Seen {
        std::uint32_t id = kNoIndex;  ///< of the joint or coupling; kNoIndex: there was none
        double error = 0;             ///< [m], [rad]
        double time = 0;              ///< [s]
    };

    void add(const Seen& seen);

    std::uint64_t steps() const { return steps_; }  ///< that had any
    const Seen& first() const { return first_; }
    const Seen& worst() const { return worst_; }
    const Seen& last() const { return last_; }  ///< of the last step, whether it had any or not

private:
    std::uint64_t steps_ = 0;
    Seen first_, worst_, last_;
};

/// Whether there are deformables, and these are iterated (`exact_deformables`).
inline bool sweeps_deformables(const World& world) {
    return world.particles.size() > world.settings.exact_deformables;
}

/// Joints and couplings that gape (effects/report.h), and trees that Newton's steps left open.
class JointWatch {
public:
    /// Takes what the step that was just made tells.
    void add(const World& world, const StepReport& report);

    /// By joints' points [m]; by their bodies' turn [rad]; by couplings [m], [rad].
    const ErrorWatch& apart() const { return apart_; }
    const ErrorWatch& turned() const { return turned_; }
    const ErrorWatch& slipped() const { return slipped_; }
    /// Trees, by a joint of theirs [m], [rad].
    const ErrorWatch& trees() const { return trees_; }

    /// Over the run and at its end, by kind; what there was none of is null.
    nlohmann::ordered_json json(const Scene& scene, const World& world) const;

    /// A sentence for each kind that there was any of.
    std::vector<std::string> warnings(const Scene& scene, const World& world) const;

private:
    ErrorWatch apart_, turned_, slipped_, trees_;
};

}  // namespace plumb::app
