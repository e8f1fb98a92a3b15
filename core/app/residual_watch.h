// SPDX-License-Identifier: MIT
/// How far the steps of a run are from solving their constraints (effects/residual.h).
#pragma once

#include "effects/report.h"
#include "world/world.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>

namespace plumb::app {

class ResidualWatch {
public:
    /// Takes what the step that was just made tells.
    void add(const World& world, const StepReport& report);

    /// Over the run and at its end; islands that nothing is told of are null.
    nlohmann::ordered_json json() const;

    /// A sentence about the worst island of the run, empty where there was none.
    std::string in_words(const Settings& settings) const;

private:
    /// An island at a moment; its first body by its identifier.
    struct Seen {
        IslandResidual island;
        std::uint32_t first_body = kNoIndex;
        double time = 0;  ///< [s]
    };
    static nlohmann::ordered_json json_of(const Seen& seen);

    std::uint64_t steps_ = 0;       ///< with islands
    double sum_ = 0;                ///< of their greatest force of weight
    double force_ = 0, error_ = 0;  ///< the greatest so far [N], [m]
    Seen worst_, last_;
    StepResidual end_;
};

}  // namespace plumb::app
