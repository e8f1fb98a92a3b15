// SPDX-License-Identifier: MIT
#include "trees/tree_solver.h"

#include "constraints/connector.h"
#include "ties/lever_of.h"

#include <limits>

namespace plumb {
namespace {

std::vector<std::uint8_t> driven_joints(const World& world) {
    std::vector<std::uint8_t> driven(world.joints.size(), 0);
    for (const JointDrive& drive : world.joints.drives) driven[drive.joint] = 1;
    return driven;
}

std::vector<std::uint8_t> undriven_balls(const World& world, const JointForest& forest) {
    std::vector<std::uint8_t> plain;
    const std::vector<std::uint8_t> driven = driven_joints(world);
    for (const ForestNode& node : forest.nodes)
        plain.push_back(node.parent != kFree && !driven[node.joint] &&
                        world.joints.joints[node.joint].is_plain_ball());
    return plain;
}

/// Of the point by which a tree hangs from what a script moves, else none [m/s].
Vector3d holder_velocity(const World& world, const Joint& joint) {
    const Bodies& b = world.bodies;
    const auto velocity = [&](std::uint32_t body, const Placement& frame) -> Vector3d {
        if (body == kNoIndex || b.motion[body] != Motion::kinematic) return Vector3d::Zero();
        return velocity_at<double>({b.velocity[body], b.angular_velocity[body]},
                                   b.orientation[body] * frame.position);
    };
    return velocity(joint.a, joint.frame_a) + velocity(joint.b, joint.frame_b);
}

}  // namespace

template <int W>
TreeSolver<W>::TreeSolver(const World& world, const JointForest& forest, double tolerance)
    : tolerance_(tolerance),
      tables_(forest.nodes.size()),
      progress_(forest, driven_joints(world)),
      nodes_(world, forest, undriven_balls(world, forest), progress_, tables_) {
    lay_out(world, forest, undriven_balls(world, forest));
    load_impulses(world.joints);
    open_.reserve(progress_.trees());
    path_.resize(forest.nodes.size());
    each_body([&](std::uint32_t node, std::uint32_t body, const Vector3d&) {
        progress_.note_mass(node, world.bodies.mass[body]);
    });
    any_loaded_ = progress_.any_loaded();
}

template <int W>
void TreeSolver<W>::lay_out(const World& world, const JointForest& forest,
                            const std::vector<std::uint8_t>& side_by_side) {
    for (TreeGroup& group : find_tree_groups(forest, side_by_side)) {
        const std::size_t first = balls_.size();
        if (group.side_by_side) add_blocks(world, forest, group.nodes);
        spans_.push_back({first, balls_.size() - first, group.first, group.leaves, {}});
        if (!group.side_by_side) spans_.back().singles = std::move(group.nodes);
    }
}

template <int W>
void TreeSolver<W>::add_blocks(const World& world, const JointForest& forest,
                               const std::vector<std::uint32_t>& group) {
    for (std::size_t i = 0; i < group.size(); i += N) {
        TreeBalls<N>& balls = balls_.emplace_back();
        for (int lane = 0; lane < N; ++lane) {
            const bool used = i + static_cast<std::size_t>(lane) < group.size();
            const std::uint32_t node = group[used ? i + static_cast<std::size_t>(lane) : i];
            place(world, forest.nodes[node], node, balls, lane);
            balls.used[lane] = balls.active[lane] = used;
            if (!used) balls.node[lane] = tables_.idle, balls.parent[lane] = tables_.ground;
            joint_of_.push_back(forest.nodes[node].joint);
        }
    }
    kept_.resize(balls_.size());
}

template <int W>
void TreeSolver<W>::place(const World& world, const ForestNode& from, std::uint32_t node,
                          TreeBalls<N>& balls, int lane) const {
    const Joint& joint = world.joints.joints[from.joint];
    const bool is_a =
        world.bodies.motion[joint.a] == Motion::dynamic && world.bodies.row[joint.a] == from.row;
    const std::uint32_t body = is_a ? joint.a : joint.b, other = is_a ? joint.b : joint.a;
    balls.node[lane] = node;
    balls.parent[lane] =
        from.parent >= 0 ? static_cast<std::uint32_t>(from.parent) : tables_.ground;
    balls.body[lane] = body;
    balls.other[lane] = other == kNoIndex ? body : other;
    balls.row[lane] = from.row;
    balls.hung[lane] = progress_.hangs(node);
    balls.held[lane] = other == kNoIndex;
    balls.sign[lane] = is_a ? 1 : -1;
    balls.meet[lane] = 1;
    const Placement& own_frame = is_a ? joint.frame_a : joint.frame_b;
    const Placement& other_frame = is_a ? joint.frame_b : joint.frame_a;
    for (int k = 0; k < 3; ++k) {
        balls.point[k][lane] = own_frame.position[k];
        balls.other_point[k][lane] = other_frame.position[k];
    }
}

template <int W>
void TreeSolver<W>::load_impulses(const JointTable& joints) {
    for (std::size_t i = 0; i < balls_.size(); ++i)
        for (int lane = 0; lane < N; ++lane) {
            TreeBalls<N>& balls = balls_[i];
            const Joint& joint = joints.joints[joint_of_[i * N + static_cast<std::size_t>(lane)]];
            for (int k = 0; k < 3; ++k) balls.impulse[k][lane] = balls.sign[lane] * joint.rows[k];
            balls.load[lane] = load_of(joint, kAlongX, JointSolve::tree);
        }
    nodes_.load_impulses(joints);
}

/// Others change the velocities of trees that are left out.
template <int W>
void TreeSolver<W>::rest_left_out() {
    for (TreeBalls<N>& balls : balls_)
        for (int lane = 0; lane < N; ++lane)
            if (balls.used[lane] > 0 && progress_.is_left_out(balls.node[lane]))
                for (auto& own : balls.own) own[lane] = 0;
    nodes_.rest_left_out();
}

/// Calls visit(node, body, its velocity as forces leave it [m/s]).
template <int W>
template <class Visit>
void TreeSolver<W>::each_body(Visit visit) const {
    for (const TreeBalls<N>& balls : balls_)
        for (int lane = 0; lane < N; ++lane)
            if (balls.used[lane] > 0)
                visit(balls.node[lane], balls.body[lane],
                      Vector3d(balls.start[0][lane], balls.start[1][lane], balls.start[2][lane]));
    nodes_.each_body(visit);
}

/// Without gravity nothing falls, and all is high.
template <int W>
void TreeSolver<W>::note_falls(const World& world) {
    constexpr double high = std::numeric_limits<double>::infinity();
    const double gravity = world.settings.gravity.norm();
    progress_.forget_falls(h_, [&](std::uint32_t joint) {
        return holder_velocity(world, world.joints.joints[joint]);
    });
    each_body([&](std::uint32_t node, std::uint32_t body, const Vector3d& v) {
        const double squared = (v - progress_.holder_velocity(node)).squaredNorm();
        const double height = gravity > 0 ? 0.5 * squared / gravity : high;
        progress_.note_fall(node, world.bodies.mass[body], height);
    });
}

template <int W>
void TreeSolver<W>::keep_share(double share) {
    const auto scale = [share](double& x) { x = share > 0 ? share * x : 0; };
    for (TreeBalls<N>& balls : balls_)
        for (int lane = 0; lane < N; ++lane) {
            for (auto& own : balls.own) scale(own[lane]);
            for (auto& impulse : balls.impulse) scale(impulse[lane]);
        }
    nodes_.keep_share(share);
}

template <int W>
void TreeSolver<W>::take_velocities(Bodies& bodies) const {
    for (const TreeBalls<N>& balls : balls_)
        for (int lane = 0; lane < N; ++lane) {
            if (!(balls.used[lane] > 0)) continue;
            const std::uint32_t body = balls.body[lane];
            for (int k = 0; k < 3; ++k) {
                bodies.velocity[body][k] = balls.start[k][lane] + balls.own[k][lane];
                bodies.turn_change[body][k] = balls.own[3 + k][lane];
                bodies.angular_velocity[body][k] =
                    balls.start[3 + k][lane] + balls.own[3 + k][lane];
            }
        }
    nodes_.take_velocities(bodies);
}

template <int W>
template <class Real>
void TreeSolver<W>::take(const BodyRows<Real>& rows) {
    for (TreeBalls<N>& balls : balls_)
        for (int lane = 0; lane < N; ++lane) {
            const Real* row = rows.change + std::ptrdiff_t(balls.row[lane]) * kBodyRowSize;
            for (int k = 0; k < 6; ++k) {
                const double change = double(row[k < 3 ? k : k + 1]) - balls.written[k][lane];
                balls.start[k][lane] += change;
                balls.given[k][lane] += change;
            }
        }
    nodes_.take(rows);
}

template <int W>
template <class Real>
void TreeSolver<W>::give(const BodyRows<Real>& rows) {
    for (TreeBalls<N>& balls : balls_)
        for (int lane = 0; lane < N; ++lane) {
            if (!(balls.used[lane] > 0)) continue;
            Real* row = rows.change + std::ptrdiff_t(balls.row[lane]) * kBodyRowSize;
            for (int k = 0; k < 6; ++k) {
                Real& change = row[k < 3 ? k : k + 1];
                change = static_cast<Real>(balls.given[k][lane] + balls.own[k][lane]);
                balls.written[k][lane] = double(change);
            }
        }
    nodes_.give(rows);
}

template <int W>
template <class Real>
void TreeSolver<W>::solve(const BodyRows<Real>& rows, bool alone) {
    if (progress_.leaves_all_out()) {
        open_.clear(), braked_ = 0;
        return;
    }
    if (!alone) take(rows);
    solve({.closes = false, .follows = true});
    give(rows);
}

template <int W>
void TreeSolver<W>::solve(Effort effort) {
    open_.clear();
    braked_ = 0;
    levers_of_the_end_ = false;
    if (!progress_.start()) return;
    if (find_balance() || (effort.closes && close())) return;
    levers_of_the_end_ = true;
    turn_levers_to_the_end();
    forget();
    if (find_balance()) return;
    if (effort.follows &&
        !progress_.leave_one_by_one([this](auto... of) { return follow_from_rest(of...); }))
        return mark_active();
    mark_active();
    if (close()) return;
    leave_open();
}

/// What cannot be closed stays as it is if that is no worse than before any step; else as a single
/// step leaves it, if that is; else nothing holds it in this substep.
template <int W>
void TreeSolver<W>::leave_open() {
    const auto note_open = [this](std::uint32_t joint, double error) {
        note_open_tree(open_, {joint, error});
    };
    if (!progress_.leave_those_no_worse(note_open)) return;
    mark_active();
    forget();
    eliminate(false);
    substitute(false);
    evaluate(AxisLook::same_piece);
    if (!progress_.leave_those_no_worse(note_open)) return;
    mark_active();
    forget();
    progress_.each_open(note_open);
}

/// Newton's steps, which find λ anew, so that M (v − v*) = Jᵀ λ holds where they end. Returns
/// whether all trees are closed; the others are left active.
template <int W>
bool TreeSolver<W>::find_balance() {
    for (int step = 0;; ++step) {
        evaluate(step == 0 && !fresh_ ? AxisLook::anew : AxisLook::before);
        if (fresh_) progress_.remember_start();
        const bool fine = step < kFineSteps;
        if (!fresh_ && !(fine ? progress_.leave_those_closed(tolerance_)
                              : progress_.leave_those_within(tolerance_)))
            break;
        fresh_ = false;
        if (step == kBalancedSteps || !step_on(true)) break;
    }
    return bring_back();
}

/// Steps that only close joints, with the same return. They may add energy. Those that something
/// drives are told as open all the same.
template <int W>
bool TreeSolver<W>::close() {
    mark_active();
    forget();
    for (int step = 0; step < kClosingSteps; ++step) {
        if (!step_on(false)) break;
        evaluate(AxisLook::same_piece);
        if (!progress_.leave_undriven_within(tolerance_)) break;
    }
    return bring_back();
}

/// One step of each tree. Returns whether any is left after it.
template <int W>
bool TreeSolver<W>::step_on(bool balance) {
    mark_active();
    progress_.find_last_steps(tolerance_);
    const bool looks = balance && progress_.any_driven();
    if (looks) keep();
    eliminate(balance);
    substitute(balance);
    if (looks) settle_pieces();
    const bool left = progress_.leave_those_that_end();
    mark_active();
    return left;
}

/// Takes the step again from where it began until each axis ends on the piece of its force law that
/// it was taken for: where the poses are is looked at only then, for on the way rates may be any.
template <int W>
void TreeSolver<W>::settle_pieces() {
    progress_.begin_step();
    for (;;) {
        each_single([this](std::uint32_t node) {
            progress_.note_wrong_pieces(node, nodes_.look_at_axes(node, tolerance_));
        });
        if (!progress_.leave_settled()) break;
        mark_active();
        each_single([this](std::uint32_t node) {
            progress_.count_changes(
                node, nodes_.change_pieces(node, tolerance_, progress_.changes_left(node)));
        });
        take_back();
        eliminate(true);
        substitute(true);
    }
    progress_.bring_back(false);
}

/// Where the step begins.
template <int W>
void TreeSolver<W>::keep() {
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        std::copy(&balls_[i].own[0][0], &balls_[i].own[0][0] + 6 * N, kept_[i].own);
        std::copy(&balls_[i].impulse[0][0], &balls_[i].impulse[0][0] + 3 * N, kept_[i].impulse);
    }
    each_single([this](std::uint32_t node) { nodes_.keep(node); });
}
template <int W>
void TreeSolver<W>::take_back() {
    for (std::size_t i = 0; i < balls_.size(); ++i)
        for (int lane = 0; lane < N; ++lane) {
            if (!(balls_[i].active[lane] > 0)) continue;
            for (int k = 0; k < 6; ++k) balls_[i].own[k][lane] = kept_[i].own[k * N + lane];
            for (int k = 0; k < 3; ++k) balls_[i].impulse[k][lane] = kept_[i].impulse[k * N + lane];
        }
    each_single([this](std::uint32_t node) { nodes_.take_back(node); });
}

/// Trees that waited, as the last step left them. Returns whether there is none to be solved.
template <int W>
bool TreeSolver<W>::bring_back() {
    const bool any = progress_.bring_back(true);
    mark_active();
    if (any) evaluate(AxisLook::same_piece);
    return !any;
}

/// Levers of the end, with which Newton's matrix is the derivative of what it closes, for trees
/// that turn too far within the substep for their own.
template <int W>
void TreeSolver<W>::turn_levers_to_the_end() {
    for (TreeBalls<N>& balls : balls_)
        for (int lane = 0; lane < N; ++lane) {
            if (!(balls.active[lane] > 0)) continue;
            balls.share[lane] = 1;
            balls.other_share[lane] = balls.parent[lane] != tables_.ground;
            for (int k = 0; k < 3; ++k) balls.lag[k][lane] = balls.other_lag[k][lane] = 0;
        }
    for (const Span& span : spans_)
        for (const std::uint32_t node : span.singles)
            if (progress_.is_active(node)) nodes_.turn_levers_to_the_end(node);
}

/// Back to v*, where a search that led nowhere began.
template <int W>
void TreeSolver<W>::forget() {
    for (TreeBalls<N>& balls : balls_)
        for (int lane = 0; lane < N; ++lane) {
            if (!(balls.active[lane] > 0)) continue;
            for (auto& own : balls.own) own[lane] = 0;
            for (auto& impulse : balls.impulse) impulse[lane] = 0;
        }
    for (const Span& span : spans_)
        for (const std::uint32_t node : span.singles)
            if (progress_.is_active(node)) nodes_.forget(node);
    evaluate(AxisLook::same_piece);
}

/// Poses at the preview, how far they are off, and how stiff the joints' impulses make the turns.
template <int W>
void TreeSolver<W>::evaluate(AxisLook look) {
    progress_.look_again();
    for (const Span& span : spans_) {
        note(span, kernels_.evaluate(balls_.data() + span.first, span.count, columns(), h_));
        for (const std::uint32_t node : span.singles)
            if (progress_.is_active(node)) progress_.note(node, nodes_.evaluate(node, look));
    }
}

/// How far bodies that are solved side by side are off.
template <int W>
void TreeSolver<W>::note(const Span& span, double greatest) {
    if (span.count == 0) return;
    if (progress_.trees() == 1) return progress_.note(0, greatest);
    for (std::size_t i = span.first; i < span.first + span.count; ++i)
        for (int lane = 0; lane < N; ++lane)
            if (balls_[i].used[lane] > 0)
                progress_.note(balls_[i].node[lane], balls_[i].violation[lane]);
}

template <int W>
void TreeSolver<W>::mark_active() {
    if (progress_.trees() == 1) return;
    for (TreeBalls<N>& balls : balls_)
        for (int lane = 0; lane < N; ++lane)
            balls.active[lane] = balls.used[lane] > 0 && progress_.is_active(balls.node[lane]);
}

/// From the leaves to the roots. `balance`: λ is found anew, so that M (v − v*) = Jᵀ λ holds with
/// this J; else what is missing is added.
template <int W>
void TreeSolver<W>::eliminate(bool balance) {
    for (auto span = spans_.rbegin(); span != spans_.rend(); ++span) {
        kernels_.eliminate(balls_.data() + span->first, span->count, columns(), h_, balance,
                           span->comes_first, span->leaves);
        for (const std::uint32_t node : span->singles)
            if (progress_.is_active(node))
                nodes_.eliminate(node, balance, span->comes_first, span->leaves);
    }
}

/// From the roots to the leaves.
template <int W>
void TreeSolver<W>::substitute(bool balance) {
    for (const Span& span : spans_) {
        kernels_.substitute(balls_.data() + span.first, span.count, columns(), h_, balance);
        for (const std::uint32_t node : span.singles)
            if (progress_.is_active(node)) nodes_.substitute(node, balance);
    }
}

template <int W>
void TreeSolver<W>::store_impulses(JointTable& joints) {
    constexpr std::size_t kAhead = 8;  // joints that are fetched while others are written
    for (std::size_t i = 0; i < balls_.size(); ++i)
        for (int lane = 0; lane < N; ++lane) {
            TreeBalls<N>& balls = balls_[i];
            const std::size_t ahead = i * N + static_cast<std::size_t>(lane) + kAhead;
            if (ahead < joint_of_.size() && joint_of_[ahead] < joints.size()) {
                const Joint& next = joints.joints[joint_of_[ahead]];
                __builtin_prefetch(&next.rows, 1), __builtin_prefetch(&next.rows_before, 1);
            }
            if (!(balls.used[lane] > 0) || progress_.is_left_out(balls.node[lane])) continue;
            Joint& joint = joints.joints[joint_of_[i * N + static_cast<std::size_t>(lane)]];
            for (int k = 0; k < 3; ++k) {  // a plain ball has no other rows
                joint.rows_before[k] = joint.rows[k];
                joint.rows[k] = balls.sign[lane] * balls.impulse[k][lane];
            }
            balls.load[lane] = load_of(joint, kAlongX, JointSolve::tree);
        }
    nodes_.store_impulses(joints);
}

#define PLUMB_INSTANTIATE(W)                                          \
    template class TreeSolver<W>;                                     \
    template void TreeSolver<W>::solve(const BodyRows<float>&, bool); \
    template void TreeSolver<W>::solve(const BodyRows<double>&, bool);
PLUMB_INSTANTIATE(1)
PLUMB_INSTANTIATE(4)
PLUMB_INSTANTIATE(8)
PLUMB_INSTANTIATE(16)
#undef PLUMB_INSTANTIATE

}  // namespace plumb
