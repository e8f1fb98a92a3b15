// SPDX-License-Identifier: MIT
/// Joints that form trees, solved exactly: Newton steps on
///
///   M (v − v*) = J(v)ᵀ λ,   C(v)/h + s λ = 0
///
/// with C and J at the preview poses, each by block LDLᵀ from the leaves to the roots and back, at
/// a cost linear in the number of bodies. v* is what forces, contacts and other joints make of the
/// velocity. Since J is that of the poses at the end of the substep, stiff trees (a light rod that
/// carries a heavy load) stay calm; Newton's matrix holds, beside M, how the joints' torques turn
/// with the bodies. Numbers are double, whatever the rows' precision.
///
/// Bodies on plain balls are solved several side by side, level by level; those on other or driven
/// joints, and roots that hang by nothing, one by one (tree_nodes.h). What drives a joint is part
/// of the system: a step is taken again until each axis ends on that piece of its force law
/// (constraints/axis_drive.h) that it was taken for. Where no solution is found from v*, a way to
/// one is followed from rest (trees/tree_path.h).
#pragma once

#include "effects/report.h"
#include "kernels/body_columns.h"
#include "kernels/tree_kernels.h"
#include "schedule/tree_levels.h"
#include "trees/tree_nodes.h"
#include "trees/tree_path.h"

#include <algorithm>
#include <vector>

namespace plumb {

template <int W>
class TreeSolver {
public:
    /// `tolerance`: up to which joints are closed [m], [rad].
    TreeSolver(const World& world, const JointForest& forest, double tolerance);

    /// Arms, gaps, masses and velocities at the start of a substep of length h [s]. Newton's steps
    /// start where joints that hang by something undo gravity: most of what hangs is near its rest.
    void begin(const World& world, const SubstepTime& time) {
        if (progress_.leaves_all_out()) return;
        world_ = &world, h_ = time.h, fresh_ = true;
        const Vector3d lift = -h_ * world.settings.gravity;
        kernels_.begin(balls_.data(), balls_.size(), states_of(world.bodies), h_,
                       {lift[0], lift[1], lift[2]}, h_ * world.settings.recovery_speed);
        nodes_.begin(world, time, lift);
        if (any_loaded_) note_falls(world);
        if (progress_.leaves_any_out()) rest_left_out();
    }

    /// Trees that are advanced by themselves are not solved; `is_left_out(joint)`. Returns whether
    /// any is back, with impulses that are to be loaded.
    template <class IsLeftOut>
    bool leave_out(IsLeftOut is_left_out) {
        return progress_.leave_out(is_left_out);
    }

    /// What is done where Newton's steps do not succeed.
    struct Effort {
        bool closes;   ///< steps that may add energy: the caller sees to that
        bool follows;  ///< a way from rest (trees/tree_path.h)
    };

    /// Newton steps until no row is violated by more than the tolerance.
    void solve(Effort effort);
    /// The same among others that change velocities, unless the trees are `alone`.
    template <class Real>
    void solve(const BodyRows<Real>& rows, bool alone);

    /// Whether the last solve closed some trees only with levers of the substep's end, which lose
    /// energy: with those of its start, there was no solution near.
    bool took_levers_of_the_end() const { return levers_of_the_end_; }

    /// How many trees the last solve braked, or closed by less than asked (trees/tree_path.h).
    std::uint32_t braked() const { return braked_; }

    /// What the last solve left open.
    const std::vector<OpenTree>& open() const { return open_; }

    /// Gives each body the rate rate_of(body, what the last solve changed of it), without touching
    /// those changes. Returns by how much at the most [rad/s].
    template <class RateOf>
    double correct_rates(RateOf rate_of) {
        double most = nodes_.correct_rates(rate_of);
        for (TreeBalls<N>& balls : balls_)
            for (int lane = 0; lane < N; ++lane) {
                if (!(balls.used[lane] > 0)) continue;
                const auto at = [lane](const double(&x)[6][N]) {
                    return Vector3d(x[3][lane], x[4][lane], x[5][lane]);
                };
                const Vector3d start = rate_of(balls.body[lane], at(balls.own)) - at(balls.own);
                most = std::max(most, (start - at(balls.start)).norm());
                for (int k = 0; k < 3; ++k) balls.start[3 + k][lane] = start[k];
            }
        return most;
    }

    /// Keeps a share of what the last solve changed, and of its impulses.
    void keep_share(double share);

    /// The velocities that the last solve has come to, and what it changed of the turns.
    void take_velocities(Bodies& bodies) const;

    /// Joint::rows, as the guess to begin from.
    void load_impulses(const JointTable& joints);

    /// Impulses of the last substep, into Joint::rows.
    void store_impulses(JointTable& joints);

private:
    static constexpr int N = kBodyLanes<W>;
    /// Newton steps at the most that hold the balance of momentum at the end of the substep, and,
    /// if they do not succeed, that only close the joints.
    static constexpr int kBalancedSteps = 10, kClosingSteps = 10;
    /// So many of the former are made for the sake of what a swing gains or loses.
    static constexpr int kFineSteps = 6;

    /// What a step changes of balls.
    struct Kept {
        double own[6 * N], impulse[3 * N];
    };

    /// A group of bodies: blocks, or those that are solved one by one.
    struct Span {
        std::size_t first, count;
        bool comes_first, leaves;  ///< as in TreeGroup
        std::vector<std::uint32_t> singles;
    };

    void lay_out(const World& world, const JointForest& forest,
                 const std::vector<std::uint8_t>& side_by_side);
    void add_blocks(const World& world, const JointForest& forest,
                    const std::vector<std::uint32_t>& group);
    void place(const World& world, const ForestNode& from, std::uint32_t node, TreeBalls<N>& balls,
               int lane) const;
    template <class Real>
    void take(const BodyRows<Real>& rows);
    template <class Real>
    void give(const BodyRows<Real>& rows);

    void rest_left_out();
    template <class Visit>
    void each_body(Visit visit) const;
    void note_falls(const World& world);
    bool find_balance();
    bool close();
    bool step_on(bool balance);
    void settle_pieces();
    void keep();
    void take_back();
    bool bring_back();
    template <class Change>
    void change_velocities(Change change);
    template <class Change>
    void change_deferred(Change change);
    void let_arms_meet(double meet);
    RigidMotion free_motion();
    class PathFromRest;
    bool follow_from_rest(std::size_t tree, std::uint32_t joint, bool hangs);
    void leave_open();
    void turn_levers_to_the_end();
    void forget();
    void evaluate(AxisLook look);
    void note(const Span& span, double greatest);
    void mark_active();
    void eliminate(bool balance);
    void substitute(bool balance);

    /// Calls visit(node) for the bodies that are solved one by one and still to be solved.
    template <class Visit>
    void each_single(Visit visit) const {
        for (const Span& span : spans_)
            for (const std::uint32_t node : span.singles)
                if (progress_.is_active(node)) visit(node);
    }

    TreeColumns columns() {
        return {tables_.turn.data(), tables_.velocity.data(), tables_.share.data(),
                tables_.step.data()};
    }

    const TreeKernels<W>& kernels_ = tree_kernels<W>();
    double tolerance_, h_ = 0;
    const World* world_ = nullptr;  ///< that of the substep
    std::uint32_t braked_ = 0;
    std::vector<OpenTree> open_;
    bool fresh_ = true;  ///< no step was made in this substep
    bool levers_of_the_end_ = false;
    bool any_loaded_ = false;  ///< whether falls are to be noted
    TreeTables tables_;
    TreeProgress progress_;
    TreeNodes nodes_;
    std::vector<TreeBalls<N>> balls_;
    std::vector<Kept> kept_;               ///< [block of balls_]
    std::vector<PathNode> path_;           ///< [node]
    std::vector<std::uint32_t> joint_of_;  ///< [block of balls_ × N + lane]
    std::vector<Span> spans_;              ///< roots first
};

}  // namespace plumb
