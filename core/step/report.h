// SPDX-License-Identifier: MIT
/// What a step tells about itself: trouble is a flag with a count, never an end of what was
/// computed.
#pragma once

#include <cstdint>
#include <string>

namespace plumb {

struct StepReport {
    std::uint32_t contacts = 0;            ///< contact points
    std::uint32_t clamped_recoveries = 0;  ///< contacts, summed over substeps, whose overlap was
                                           ///< deeper than one substep may push out
    std::uint32_t rejected_contacts = 0;   ///< left out: not finite, or of an unknown body
    bool finite = true;                    ///< no position or velocity is NaN or infinite
    bool collider_failed = false;          ///< the collider reported trouble: see `message`
    std::string message;
};

}  // namespace plumb
