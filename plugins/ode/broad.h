// SPDX-License-Identifier: MIT
/// ODE's hash space over the bounds of our parts.
///
/// The space holds one stand-in a part, a geom of a class of our own whose bounds are read from the
/// table: so the space sees bounds that are grown by the distance of detection, and geoms stay out
/// of any space.
#pragma once

#include "manifold/body_table.h"

#include <ode/ode.h>

namespace plumb::ode {

class HashSpace {
public:
    HashSpace();
    ~HashSpace();
    HashSpace(const HashSpace&) = delete;
    HashSpace& operator=(const HashSpace&) = delete;

    /// Adds all pairs of parts whose bounds overlap and that are to be tested.
    void find_pairs(std::vector<PartPair>& pairs, const BodyTable& table);

private:
    void refill(const BodyTable& table);
    void choose_levels(const BodyTable& table);

    dSpaceID space_;
    std::vector<dGeomID> stand_ins_;  ///< [part]
    std::uint64_t version_ = ~std::uint64_t{0};
};

}  // namespace plumb::ode
