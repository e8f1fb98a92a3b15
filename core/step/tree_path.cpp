// SPDX-License-Identifier: MIT
#include "step/tree_path.h"

#include "step/tree_solver.h"

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

RestMotion motion_of_holder(const World& world, const Joint& joint) {
    const Bodies& b = world.bodies;
    RestMotion rest;
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
RestMotion TreeSolver<W>::free_motion() {
    return motion_as_one(world_->bodies, [&](auto visit) {
        change_velocities([&](std::uint32_t, std::uint32_t body, const Velocity<double>& start,
                              const Velocity<double>&) { visit(body, start); });
    });
}

/// Returns whether a solution is found for any share.
template <int W>
bool TreeSolver<W>::follow_from_rest(std::size_t tree, std::uint32_t joint, bool hangs) {
    const Bodies& b = world_->bodies;
    mark_active();
    forget();
    using Rate = Velocity<double>;
    const RestMotion rest =
        hangs ? motion_of_holder(*world_, world_->joints.joints[joint]) : free_motion();
    change_velocities([&](std::uint32_t node, std::uint32_t body, const Rate& start, Rate& own) {
        path_[node] = {start, rest.of(b, body), own, {}};
    });
    change_deferred([&](std::uint32_t node, int k, double, double& deferred) {
        path_[node].deferred[k] = deferred;
    });
    let_arms_meet(0);

    double motion = -1, closing = 0;  // shares that are solved; nothing is so far
    bool lost = false;
    const auto put_last = [&](double m, double c) {
        progress_.begin_anew(tree);
        mark_active();
        if (lost) forget();
        change_velocities([&](std::uint32_t node, std::uint32_t, Rate& start, Rate& own) {
            start = between(path_[node].rest, path_[node].goal, m);
            own = path_[node].last;
        });
        change_deferred([&](std::uint32_t node, int k, double old, double& deferred) {
            deferred = old + c * (path_[node].deferred[k] - old);
        });
    };
    const auto solve_for = [&](double m, double c) {
        put_last(m, c);
        if (lost) {  // impulses, too
            evaluate(AxisLook::anew);
            step_on(true);
            progress_.begin_anew(tree);
            mark_active();
        }
        const bool solved = find_balance();
        progress_.begin_anew(tree);
        mark_active();
        lost = !solved;
        if (lost) return false;
        motion = m, closing = c;
        change_velocities([&](std::uint32_t node, std::uint32_t, const Rate&, Rate& own) {
            path_[node].last = own;
        });
        return true;
    };
    if (solve_for(0, 0)) {
        grow(motion, [&](double next) { return solve_for(next, closing); });
        grow(closing, [&](double next) { return solve_for(motion, next); });
        if (lost && !solve_for(motion, closing)) put_last(motion, closing);
    }
    change_velocities([&](std::uint32_t node, std::uint32_t, Rate& start, Rate& own) {
        own = motion < 0 ? Rate{Vector3d::Zero(), Vector3d::Zero()}
                         : Rate{start.v + own.v - path_[node].goal.v,
                                start.w + own.w - path_[node].goal.w};
        start = path_[node].goal;
    });
    change_deferred([&](std::uint32_t node, int k, double, double& deferred) {
        deferred = path_[node].deferred[k];
    });
    let_arms_meet(1);
    evaluate(AxisLook::same_piece);
    braked_ += motion >= 0 && (motion < 1 || closing < 1);
    return motion >= 0;
}

#define PLUMB_INSTANTIATE(W) \
    template bool TreeSolver<W>::follow_from_rest(std::size_t, std::uint32_t, bool);
PLUMB_INSTANTIATE(1)
PLUMB_INSTANTIATE(4)
PLUMB_INSTANTIATE(8)
PLUMB_INSTANTIATE(16)
#undef PLUMB_INSTANTIATE

}  // namespace plumb
