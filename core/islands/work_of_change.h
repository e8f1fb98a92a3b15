// SPDX-License-Identifier: MIT
/// The work that takes the bodies of an island from some velocities to others.
#pragma once

#include "contacts/contact_work.h"
#include "ties/solved_body.h"

#include <span>

namespace plumb {

/// As the impulses of contacts do it that change velocities so; from, to: [body].
inline ContactWork work_of_change(std::span<const SolvedBody> bodies,
                                  std::span<const Vector6d> from, std::span<const Vector6d> to) {
    ContactWork work;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Vector6d change = to[i] - from[i];
        const Vector6d more = momentum(bodies[i], change);
        work.at_start += from[i].dot(more), work.of_change += 0.5 * change.dot(more);
    }
    return work;
}

}  // namespace plumb
