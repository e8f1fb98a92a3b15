// SPDX-License-Identifier: MIT
/// The kinematic body by which a tree hangs that divides its substep: in each part the world's
/// tables say where it is in that part, and after the last one what they said before. Trees that
/// hang by one body are therefore advanced one after the other.
#pragma once

#include "trees/holder_path.h"
#include "trees/tree_energy.h"

namespace plumb {

class TreeHolder {
public:
    /// The tree hangs by a joint from such a body, or from nothing that moves.
    TreeHolder(const World& world, std::uint32_t joint);

    std::uint32_t body() const { return body_; }  ///< kNoIndex: there is none
    bool moves() const { return path_.moves(); }

    /// At the start of a substep of length h [s], as for HolderPath.
    void begin(const World& world, const Plan& plan, double h);
    /// To where it is in a part, and was in that of the length `before` [s] before it; times are
    /// since the start of the substep [s].
    void place(Bodies& bodies, double from, double to, double before);
    /// Back to where it was when the substep began.
    void take_back(Bodies& bodies) const;

    /// In the part for which it was placed.
    const TreeHold& hold() const { return hold_; }

private:
    std::uint32_t body_ = kNoIndex;
    Vector3d point_ = Vector3d::Zero();  ///< of the joint, in the body's frame [m]
    HolderPath path_;
    TreeHold hold_;
    Placement start_;
    Velocity<double> velocity_, now_, before_;  ///< in the world's tables at the start
};

}  // namespace plumb
