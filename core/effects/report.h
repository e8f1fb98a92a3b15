// SPDX-License-Identifier: MIT
/// What a step tells about itself: trouble is a flag with a count, never an end of what was
/// computed.
#pragma once

#include "effects/residual.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

/// Why a contact of the collider was left out.
enum class ContactFault : std::uint32_t {
    unknown_body,   ///< of a body that there is not, or not with a < b
    not_finite,     ///< a number of it is NaN or infinite
    bad_normal,     ///< the normal is not of unit length
    unwanted_pair,  ///< of two bodies that the scene keeps apart, or of which none is dynamic
    too_far,        ///< the gap is wider than was asked for
    none
};
inline constexpr std::size_t kContactFaultCount = 5;
inline constexpr std::array<std::string_view, kContactFaultCount> kContactFaultNames{
    "of unknown bodies", "not finite", "with a normal that is not of unit length",
    "of pairs that must not touch", "with a gap beyond the margin"};

/// A tree of joints that Newton's steps did not close, named by its first joint, and how far open
/// it is [m], [rad].
struct OpenTree {
    std::uint32_t joint;
    double error;
};

/// One more of a substep's; of a tree that is known already, the greater error counts.
inline void note_open_tree(std::vector<OpenTree>& trees, const OpenTree& tree) {
    for (OpenTree& known : trees)
        if (known.joint == tree.joint) {
            known.error = std::max(known.error, tree.error);
            return;
        }
    trees.push_back(tree);
}

/// Joints and couplings that the end of a step finds open, or past a limit, so that anyone would
/// see it: by more than 1 mm, 1 % of the size of one of their bodies, or 0.01 rad. Whatever solved
/// them; joints that give way (compliance) may.
struct GapingJoints {
    std::uint32_t joints = 0, couplings = 0;        ///< how many
    double along = 0, about = 0;                    ///< of joints, at the most [m], [rad]
    double coupled = 0;                             ///< q_b − ratio q_a − offset [m], [rad]
    std::uint32_t widest = ~0u, most_turned = ~0u;  ///< the joints that these are of, by index
    std::uint32_t worst_coupling = ~0u;             ///< and the coupling
};

struct StepReport {
    std::uint32_t contacts = 0;            ///< contact points
    std::uint32_t asleep = 0;              ///< bodies that slept through it
    std::uint32_t clamped_recoveries = 0;  ///< contacts, summed over substeps, whose overlap was
                                           ///< deeper than one substep may push out
    std::uint32_t unsolved_islands = 0;   ///< islands, summed over substeps, that were to be solved
                                          ///< exactly and still miss the law of contact
    std::uint32_t costly_islands = 0;     ///< larger ones that miss Settings::accuracy and were
                                          ///< found to take too much; tried anew after a while
    std::uint32_t unsolved_trees = 0;     ///< trees of joints, summed over substeps, that could
                                          ///< not be closed
    double tree_error = 0;                ///< by how much they were open at most [m], [rad]
    std::uint32_t coarse_trees = 0;       ///< trees, summed over substeps, that are closed but snap
                                          ///< faster than their parts can follow, or are braked
                                          ///< since no whole solution is found: energy is lost
    std::uint32_t open_joint = ~0u;       ///< a joint of the tree that was open the most
    std::vector<OpenTree> open_trees;     ///< of the last substep
    GapingJoints gaping;                  ///< joints that anyone sees to be open
    std::uint32_t stretched_links = 0;    ///< links that the step left longer or shorter than
                                          ///< they may be, by more than 1 % of that, or attached
                                          ///< points apart by a tenth of their radius
    double link_error = 0;                ///< by how much they were wrong at most [m]
    std::uint32_t rejected_contacts = 0;  ///< left out for one of the faults
    std::array<std::uint32_t, kContactFaultCount> faults{};  ///< contacts left out, by fault
    std::uint32_t broken_joints = 0;                         ///< joints that gave way in this step
    std::uint32_t torn_elements = 0;  ///< of deformables, that gave way in this step
    StepResidual residual;            ///< how far its end is from the constraints
    bool finite = true;               ///< no position or velocity is NaN or infinite
    bool collider_failed = false;     ///< the collider reported trouble: see `message`
    bool collider_unusable = false;   ///< it wrote where it must not: it should not be called again
    std::string message;

    /// Counts the trees that a substep left open.
    void count_open_trees() {
        unsolved_trees += static_cast<std::uint32_t>(open_trees.size());
        for (const OpenTree& tree : open_trees)
            if (tree.error > tree_error) tree_error = tree.error, open_joint = tree.joint;
    }
};

}  // namespace plumb
