// SPDX-License-Identifier: MIT
/// How much of old overlap the iterations of contact rows remove.
#pragma once

#include "constraints/contact.h"
#include "math/root.h"
#include "scene/settings.h"

#include <cstdint>

namespace plumb {

/// What the five iterations of a step leave of old overlap, to the paper's letter: there s is the
/// share of one of them, and other numbers of iterations remove as much.
inline double left_after_five(const Settings& s) {
    const double left = 1 - s.stiffness;
    return left * left * left * left * left;
}

/// Share of old overlap that sweeps remove in a substep. Where both passes share one push it is s.
inline double share_of_substep(const Settings& s) {
    return s.shared_push ? s.stiffness : 1 - root_of_share(left_after_five(s), s.substeps);
}

/// Share by which a position iteration closes old overlap. Where both passes share one push, all
/// iterations of a substep close the same share of it.
inline double share_of_iteration(const Settings& s) {
    if (s.shared_push) return s.stiffness;
    const std::uint32_t iterations = s.position_iterations * s.substeps;
    return iterations > 0 ? 1 - root_of_share(left_after_five(s), iterations) : 0;
}

/// Removes a share of old overlap in a substep of h [s], at no more than the set speed.
inline PushOut push_out(const Settings& s, double share, double h) {
    return {share, share > 0 ? h * s.recovery_speed / share : 0};
}

}  // namespace plumb
