// SPDX-License-Identifier: MIT
/// Trees of joints that touch nothing, advanced by themselves in parts of a substep.
///
/// What keeps the energy of a swing is that a joint's impulse acts where the joint is at a
/// substep's start (constraints/joint_lever.h), which is right as long as the joint turns little
/// within it and what it bears swings nothing faster than the substep can follow. A tree of which
/// that is not so divides its substep, for itself: nothing else sees it, since it touches nothing.
/// So does one that Newton's steps did not close, and one that turned out to turn further than it
/// began.
///
/// Where a tree hangs by a body that a script moves, parts see that where it is in each of them
/// (trees/holder_path.h), and energies are those in its frame (trees/tree_energy.h).
///
/// A part is a substep, in which bodies also turn with the momentum that the joint leaves them
/// (math/free_rotation.h), and not with that of the start. As many parts as were needed are kept
/// for a while, since steps of one length are what keeps energy for good (Hairer, Lubich, Wanner,
/// Geometric Numerical Integration, VIII). Where the length changes, forces push from the middle of
/// the part before to the middle of the next, as leapfrog does.
///
/// Light links between heavy ends snap: they come to a straight line within a small part of what
/// parts are made for, and there a joint's impulse at the start's arm has no solution at all, or
/// one that is far off. A part that had to be closed otherwise, or in which energy comes or goes,
/// is therefore divided further, and so are those after it as long as they need it.
#pragma once

#include "effects/plan.h"
#include "effects/report.h"
#include "schedule/motion_lists.h"
#include "schedule/workers.h"
#include "trees/tree_holder.h"
#include "trees/tree_solver.h"

#include <deque>
#include <vector>

namespace plumb {

class DividedTrees {
public:
    DividedTrees() = default;
    DividedTrees(const World& world, const Plan& plan);

    /// Once a step, after contacts were found: which trees touch nothing.
    void find_free(const World& world);

    /// Once a substep of length h [s], before forces: into how many parts each tree divides it.
    void choose(World& world, double h);

    /// After the passes: advances the divided trees from where the substep began, and those of
    /// `report.open_trees` that are free. Returns those of `all` that are still to be moved.
    const MotionLists& advance(World& world, const Plan& plan, Workers& workers, double h,
                               const MotionLists& all, StepReport& report);

private:
    struct Tree {
        std::vector<std::uint32_t> joints;
        std::uint32_t first;  ///< joint, which keeps the pace
        bool drifts;          ///< it hangs by nothing
        TreeHolder holder;
        std::uint32_t first_of_holder = 0;  ///< tree that hangs by the same, or this one
        std::vector<std::uint32_t> bodies, drives;
        std::vector<std::uint32_t> revolute;  ///< joints whose turns are counted
        MotionLists motion;                   ///< of its bodies
        TreeSolver<1> solver;
        bool may_divide = true;    ///< nothing else ever holds or moves its bodies
        bool has_lines = false;    ///< of distance joints
        bool is_damped = false;    ///< all its joints take energy from what moves
        bool keeps_energy = true;  ///< none gives or takes any
        bool gives_none = true;    ///< none gives any: limits and friction take it
        bool is_free = false;      ///< and nothing touches them in this step
        bool was_open = false;     ///< in this substep, undivided
        bool is_coarse = false;    ///< in this substep: it was faster than its parts can follow
        double defect = 0;         ///< of energy, of a part of this substep at the most [J/J]
        std::vector<Vector3d> pushed, turned;  ///< [body of `bodies`] velocities with forces alone
        double error = -1;  ///< how far it was left open in this substep [m], [rad]; none: −1

        Tree(const World& world, const JointForest& forest);
    };

    std::vector<Tree*> share_out_bodies(const World& world, const Plan& plan);
    static bool turns_little(const Bodies& bodies, const Tree& tree, double h);
    static std::uint32_t wanted_parts(const World& world, const Tree& tree, double h);
    void advance(World& world, const Plan& plan, double h, Tree& tree) const;
    static void take_velocities(Bodies& bodies, const Tree& tree);
    static bool is_past_limit(const World& world, const Tree& tree);
    static double defect_of(const World& world, const SubstepTime& time, double fall,
                            const Tree& tree);
    void bound_gain(World& world, double h, Tree& tree) const;
    bool try_part(World& world, const Plan& plan, const SubstepTime& time, double fall, bool last,
                  bool may_snap, Tree& tree) const;
    void turn_as_free(const Bodies& bodies, double h, TreeSolver<1>::Effort effort,
                      Tree& tree) const;

    std::deque<Tree> trees_;
    std::vector<std::uint8_t> touches_, moved_, carries_momentum_;  ///< [body]
    MotionLists rest_;
};

}  // namespace plumb
