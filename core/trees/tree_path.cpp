// SPDX-License-Identifier: MIT
#include "trees/tree_path.h"

#include "trees/tree_solver.h"

namespace plumb {
namespace {

/// Of a share: by how much it is to grow first and at the least, and how often that is tried.
constexpr double kFirst = 1, kLeast = 1.0 / 128;
constexpr int kMostTries = 40;

/// `solve(next)`: returns whether it could, and has set the share to that.
template <class Solve>
void grow(const double& share, Solve solve) {
    double step = kFirst;
    for (int tries = 0; tries < kMostTries && share < 1 && step >= kLeast; ++tries)
        step *= solve(std::min(1.0, share + step)) ? 2 : 0.5;
}

Velocity<double> between(const Velocity<double>& from, const Velocity<double>& to, double share) {
    return {from.v + share * (to.v - from.v), from.w + share * (to.w - from.w)};
}

}  // namespace

RigidMotion motion_of_holder(const World& world, const Joint& joint) {
    const Bodies& b = world.bodies;
    RigidMotion rest;
    for (const std::uint32_t body : {joint.a, joint.b})
        if (body != kNoIndex && b.motion[body] != Motion::dynamic)
            rest = {b.position[body], {b.velocity[body], b.angular_velocity[body]}};
    return rest;
}

/// Calls change(node, body, start, own) for each body of trees that are still to be solved, with
/// velocities that it may change: v*, and what this solver adds to it.
template <int W>
template <class Change>
void TreeSolver<W>::change_velocities(Change change) {
    for (TreeBalls<N>& balls : balls_)
        for (int lane = 0; lane < N; ++lane) {
            if (!(balls.active[lane] > 0)) continue;
            const auto read = [lane](const double(&x)[6][N]) {
                return Velocity<double>{{x[0][lane], x[1][lane], x[2][lane]},
                                        {x[3][lane], x[4][lane], x[5][lane]}};
            };
            Velocity<double> start = read(balls.start), own = read(balls.own);
            change(balls.node[lane], balls.body[lane], start, own);
            for (int k = 0; k < 6; ++k) {
                const double to = k < 3 ? start.v[k] : start.w[k - 3];
                balls.given[k][lane] += to - balls.start[k][lane];
                balls.start[k][lane] = to;
                balls.own[k][lane] = k < 3 ? own.v[k] : own.w[k - 3];
            }
        }
    each_single([&](std::uint32_t node) {
        Velocity<double> start = nodes_.start_of(node), own = nodes_.own_of(node);
        change(node, nodes_.body_of(node), start, own);
        nodes_.put_start(node, start), nodes_.put_own(node, own);
    });
}

/// Calls change(node, row, its error at the start, the part of that that is left for later).
template <int W>
template <class Change>
void TreeSolver<W>::change_deferred(Change change) {
    for (TreeBalls<N>& balls : balls_)
        for (int lane = 0; lane < N; ++lane)
            for (int k = 0; k < 3 && balls.active[lane] > 0; ++k)
                change(balls.node[lane], k, balls.apart[k][lane], balls.deferred[k][lane]);
    each_single([&](std::uint32_t node) {
        nodes_.change_deferred(
            node, [&](int k, double old, double& deferred) { change(node, k, old, deferred); });
    });
}

/// Arms that meet keep angular momentum to rounding. Where joints are far open, these are not the
/// derivatives of what is to be closed, and Newton's steps hardly get on by them.
template <int W>
void TreeSolver<W>::let_arms_meet(double meet) {
    for (TreeBalls<N>& balls : balls_)
        for (int lane = 0; lane < N; ++lane)
            if (balls.active[lane] > 0) balls.meet[lane] = meet;
    each_single([&](std::uint32_t node) { nodes_.let_arms_meet(node, meet); });
}

/// Of the one tree that is still to be solved, which hangs by nothing.
template <int W>
RigidMotion TreeSolver<W>::free_motion() {
    return motion_as_one(world_->bodies, [&](auto visit) {
        change_velocities([&](std::uint32_t, std::uint32_t body, const Velocity<double>& start,
                              const Velocity<double>&) { visit(body, start); });
    });
}

/// The way of one tree. Shares are those that are solved: of v* against rest, and of what is to be
/// closed of old errors.
template <int W>
class TreeSolver<W>::PathFromRest {
public:
    PathFromRest(TreeSolver& trees, std::size_t tree, const RigidMotion& rest)
        : trees_(trees), nodes_(trees.path_), tree_(tree) {
        trees_.change_velocities(
            [&](std::uint32_t node, std::uint32_t body, const Rate& start, Rate& own) {
                nodes_[node] = {start, rest.of(trees_.world_->bodies, body), own, {}};
            });
        trees_.change_deferred([&](std::uint32_t node, int k, double, double& deferred) {
            nodes_[node].deferred[k] = deferred;
        });
        trees_.let_arms_meet(0);
    }

    void follow() {
        if (!solve_for(0, 0)) return;
        grow(motion_, [&](double next) { return solve_for(next, closing_); });
        grow(closing_, [&](double next) { return solve_for(motion_, next); });
        if (lost_ && !solve_for(motion_, closing_)) begin_at(motion_, closing_);
    }

    /// Gives the tree its v* back, with what is added to it for the shares that are solved.
    void end() {
        trees_.change_velocities([&](std::uint32_t node, std::uint32_t, Rate& start, Rate& own) {
            const Rate& goal = nodes_[node].goal;
            own = is_found() ? Rate{start.v + own.v - goal.v, start.w + own.w - goal.w}
                             : Rate{Vector3d::Zero(), Vector3d::Zero()};
            start = goal;
        });
        trees_.change_deferred([&](std::uint32_t node, int k, double, double& deferred) {
            deferred = nodes_[node].deferred[k];
        });
        trees_.let_arms_meet(1);
        trees_.evaluate(AxisLook::same_piece);
    }

    /// Whether a solution is found for any share, and not for all of both.
    bool is_found() const { return motion_ >= 0; }
    bool is_braked() const { return is_found() && (motion_ < 1 || closing_ < 1); }

private:
    using Rate = Velocity<double>;

    void begin_anew() {
        trees_.progress_.begin_anew(tree_);
        trees_.mark_active();
    }

    /// Begins with what was solved last.
    void begin_at(double motion, double closing) {
        begin_anew();
        if (lost_) trees_.forget();
        trees_.change_velocities([&](std::uint32_t node, std::uint32_t, Rate& start, Rate& own) {
            start = between(nodes_[node].rest, nodes_[node].goal, motion);
            own = nodes_[node].last;
        });
        trees_.change_deferred([&](std::uint32_t node, int k, double old, double& deferred) {
            deferred = old + closing * (nodes_[node].deferred[k] - old);
        });
    }

    bool solve_for(double motion, double closing) {
        begin_at(motion, closing);
        if (lost_) {  // impulses, too
            trees_.evaluate(AxisLook::anew);
            trees_.step_on(true);
            begin_anew();
        }
        lost_ = !trees_.find_balance();
        begin_anew();
        if (lost_) return false;
        motion_ = motion, closing_ = closing;
        trees_.change_velocities([&](std::uint32_t node, std::uint32_t, const Rate&, Rate& own) {
            nodes_[node].last = own;
        });
        return true;
    }

    TreeSolver& trees_;
    std::vector<PathNode>& nodes_;
    std::size_t tree_;
    double motion_ = -1, closing_ = 0;  // nothing is solved so far
    bool lost_ = false;                 // the last try came to nothing
};

/// Returns whether a solution is found for any share.
template <int W>
bool TreeSolver<W>::follow_from_rest(std::size_t tree, std::uint32_t joint, bool hangs) {
    mark_active();
    forget();
    PathFromRest path(
        *this, tree,
        hangs ? motion_of_holder(*world_, world_->joints.joints[joint]) : free_motion());
    path.follow();
    path.end();
    braked_ += path.is_braked();
    return path.is_found();
}

template bool TreeSolver<1>::follow_from_rest(std::size_t, std::uint32_t, bool);
template bool TreeSolver<4>::follow_from_rest(std::size_t, std::uint32_t, bool);
template bool TreeSolver<8>::follow_from_rest(std::size_t, std::uint32_t, bool);
template bool TreeSolver<16>::follow_from_rest(std::size_t, std::uint32_t, bool);

}  // namespace plumb
