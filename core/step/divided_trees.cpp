// SPDX-License-Identifier: MIT
#include "step/divided_trees.h"

#include "constraints/substep_time.h"
#include "math/free_rotation.h"
#include "schedule/joint_trees.h"
#include "solve/energy_loan.h"
#include "solve/free_turn.h"
#include "step/stages.h"
#include "ties/joint_state.h"
#include "ties/lever_of.h"
#include "world/body_momentum.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// How far joints may turn in a part, how far they may turn out to have turned, and what is so
/// little that the tree is solved among the others [rad].
constexpr double kTurn = 0.05, kTooFar = 0.1, kLittle = 0.005;

/// h ω of what a joint's load swings, in a part; and above which a load is so heavy that parts
/// would not do, and levers that turn with the bodies have to (constraints/joint_lever.h).
constexpr double kSwing = 0.5, kHeavy = 16;

/// h ω of what the moments of a joint may turn out to swing in a part. They come and go within less
/// than a substep: a thin rod on a universal joint, whose axis comes near the joint's first one, is
/// turned about that the faster the nearer it comes.
constexpr double kTwist = 0.2;

/// How far a body may turn in a part about an axis that misses its joint [rad], and may turn out to
/// have turned: beyond the latter, it does not turn as its joint was solved for
/// (math/free_rotation.h).
constexpr double kSpin = 0.1, kTooFast = 0.2;

/// By how much a part may change how far it turns [rad]. What whips round, as a light body whose
/// point comes near to a line through its joint, gets faster from part to part.
constexpr double kJerk = 0.01;

/// For how long fewer parts must do before fewer are taken [s]: longer than what swings quickly
/// takes to come back; and where every joint rubs, is damped or has a motor, which leaves no swing
/// to keep.
constexpr double kCalmTime = 5, kDampedCalmTime = 0.05;

/// How much of what moves a part may gain or lose, and how much is told where no more parts may be
/// taken [J/J]; and how many times as much a part of twice the length does.
constexpr double kDefect = 5e-6, kCoarse = 2e-4, kDefectOfHalf = 4;

/// How many times tree_parts there may be while something snaps, and how long they are kept [s].
constexpr std::uint32_t kSnap = 8;
constexpr double kSnapTime = 0.05;

/// What is no farther past a limit was stopped there [m], [rad].
constexpr double kPastLimit = 1e-7;

/// What is left of a joint's error by its last Newton step has always the same sign, and feeds or
/// brakes the swing: it must be small against the way of a part.
constexpr double kFiner = 0.01;

/// Rounds in which rates are corrected, and a turn that is as good as none [rad].
constexpr int kMostRounds = 8;
constexpr double kSameTurn = 1e-10;

/// How fast the line of a distance joint turns [rad/s], as a vector of that length, at most.
Vector3d line_rate(const Bodies& b, const Joint& joint, const std::vector<Vector3d>& v,
                   const std::vector<Vector3d>& w) {
    const auto velocity = [&](std::uint32_t body, const Placement& frame) -> Vector3d {
        if (body == kNoIndex) return Vector3d::Zero();
        return v[body] + w[body].cross(b.orientation[body] * frame.position);
    };
    return (velocity(joint.a, joint.frame_a) - velocity(joint.b, joint.frame_b)) / joint.length;
}

/// Of the joints that turn most [rad/s].
double angular_rate(const World& world, const std::vector<std::uint32_t>& joints) {
    const Bodies& b = world.bodies;
    double most = 0;
    for (const std::uint32_t i : joints) {
        const Joint& joint = world.joints.joints[i];
        if (joint.broken) continue;
        most = std::max({most, angular_rate(b, joint, joint.a, joint.frame_a),
                         angular_rate(b, joint, joint.b, joint.frame_b)});
        if (joint.length > 0)
            most = std::max(most, line_rate(b, joint, b.velocity, b.angular_velocity).norm());
    }
    return most;
}

/// By how much the rates of bodies and lines have changed since the part began [rad/s].
double greatest_jerk(const World& world, const std::vector<std::uint32_t>& bodies,
                     const std::vector<std::uint32_t>& joints) {
    const Bodies& b = world.bodies;
    double most = 0;
    for (const std::uint32_t i : bodies)
        most = std::max(most, (b.angular_velocity[i] - b.angular_velocity_now[i]).norm());
    for (const std::uint32_t i : joints) {
        const Joint& joint = world.joints.joints[i];
        if (joint.broken || !(joint.length > 0)) continue;
        const Vector3d before = line_rate(b, joint, b.velocity_now, b.angular_velocity_now);
        most =
            std::max(most, (line_rate(b, joint, b.velocity, b.angular_velocity) - before).norm());
    }
    return most;
}

/// h ω at which what a joint bears turns a light body, squared (constraints/joint_lever.h).
double greatest_load(const World& world, const std::vector<std::uint32_t>& joints, double h) {
    const Bodies& b = world.bodies;
    double most = 0;
    for (const std::uint32_t i : joints) {
        const Joint& joint = world.joints.joints[i];
        const auto see = [&](std::uint32_t body, const Placement& frame) {
            if (body == kNoIndex || b.motion[body] != Motion::dynamic) return;
            const Vector3d arm = b.orientation[body] * frame.position;
            most = std::max(most, tree_load(world, joint, body, arm, h));
        };
        if (!joint.broken) see(joint.a, joint.frame_a), see(joint.b, joint.frame_b);
    }
    return most;
}

/// The same of the joints' moments alone, squared.
double greatest_angular_load(const World& world, const std::vector<std::uint32_t>& joints,
                             double h) {
    double most = 0;
    for (const std::uint32_t i : joints) {
        const Joint& joint = world.joints.joints[i];
        if (joint.broken) continue;
        for (const std::uint32_t body : {joint.a, joint.b})
            if (body != kNoIndex && world.bodies.motion[body] == Motion::dynamic)
                most = std::max(most, angular_load(world, joint, body, h));
    }
    return most;
}

/// Of the bodies on their joints [rad/s].
double eccentric_spin(const World& world, const std::vector<std::uint32_t>& joints) {
    double most = 0;
    for (const std::uint32_t i : joints) {
        const Joint& joint = world.joints.joints[i];
        if (joint.broken) continue;
        most = std::max({most, eccentric_spin(world.bodies, joint.a, joint.frame_a),
                         eccentric_spin(world.bodies, joint.b, joint.frame_b)});
    }
    return most;
}

/// Whether a drive takes energy from whatever moves its axis.
bool brakes(const JointDrive& drive) {
    return drive.kind == DriveKind::friction || drive.kind == DriveKind::motor ||
           (drive.kind == DriveKind::spring && drive.spec.damping > 0);
}

/// Whether a drive never gives energy: what is within its limits, slips or is too fast is braked.
bool gives_none(const JointDrive& drive) {
    if (drive.kind == DriveKind::spring) return !(drive.spec.stiffness > 0);
    return drive.kind != DriveKind::motor;
}

std::vector<std::uint32_t> joints_of(const JointForest& tree) {
    std::vector<std::uint32_t> joints;
    for (const ForestNode& node : tree.nodes)
        if (node.parent != kFree) joints.push_back(node.joint);
    return joints;
}

/// The least power of two that is no less than x, at most `most`.
std::uint32_t parts_for(double x, std::uint32_t most) {
    std::uint32_t parts = 1;
    while (parts < x && 2 * parts <= most) parts *= 2;
    return parts;
}

/// What gravity pushed in the last `late` [s], so that velocities are those of the middle of a
/// whole substep again.
void take_back(World& world, const std::vector<std::uint32_t>& bodies, double late) {
    for (const std::uint32_t i : bodies) world.bodies.velocity[i] -= late * world.settings.gravity;
}

void scale_impulses(JointTable& table, const std::vector<std::uint32_t>& joints,
                    const std::vector<std::uint32_t>& drives, double factor) {
    for (const std::uint32_t i : joints)
        for (auto* rows : {&table.joints[i].rows, &table.joints[i].rows_before})
            for (double& x : *rows) x *= factor;
    for (const std::uint32_t i : drives)
        for (double* x : {&table.drives[i].impulse, &table.drives[i].impulse_before,
                          &table.drives[i].axis_impulse})
            *x *= factor;
}

}  // namespace

DividedTrees::Tree::Tree(const World& world, const JointForest& forest)
    : joints(joints_of(forest)),
      first(joints.front()),
      drifts(forest.nodes.front().parent == kFree),
      holder(world, first),
      solver(world, forest, kFiner * world.settings.joint_tolerance) {}

DividedTrees::DividedTrees(const World& world, const Plan& plan)
    : touches_(world.bodies.size(), 0), moved_(world.bodies.size(), 0) {
    const JointForest forest = find_forest(world);
    const auto roots = std::count_if(forest.nodes.begin(), forest.nodes.end(),
                                     [](const ForestNode& node) { return node.parent < 0; });
    std::vector<std::uint32_t> first_on(world.bodies.size(), kNoIndex);
    for (const JointForest& of : share_out_trees(forest, static_cast<std::uint32_t>(roots))) {
        const auto index = static_cast<std::uint32_t>(trees_.size());
        Tree& tree = trees_.emplace_back(world, of);
        const std::uint32_t holder = tree.holder.body();
        tree.first_of_holder = index;
        if (holder == kNoIndex) continue;
        if (first_on[holder] == kNoIndex) first_on[holder] = index;
        tree.first_of_holder = first_on[holder];
    }
    const std::vector<Tree*> tree_of = share_out_bodies(world, plan);
    const auto tree_at = [&](std::uint32_t body) {
        return body == kNoIndex ? nullptr : tree_of[body];
    };
    std::vector<Tree*> tree_with(world.joints.size(), nullptr);
    for (std::uint32_t i = 0; i < world.joints.size(); ++i) {
        const Joint& joint = world.joints.joints[i];
        for (Tree* tree : {tree_at(joint.a), tree_at(joint.b)})
            if (tree && !joint.broken && !forest.in_tree[i]) tree->may_divide = false;
        if (!forest.in_tree[i]) continue;
        const bool gives_way = joint.compliance > 0 || joint.angular_compliance > 0;
        Tree& tree = *(tree_at(joint.a) ? tree_at(joint.a) : tree_at(joint.b));
        tree_with[i] = &tree;
        tree.has_lines |= joint.length > 0;
        tree.keeps_energy &= !gives_way, tree.gives_none &= !gives_way;
    }
    for (const JointCoupling& c : world.joints.couplings)
        for (const std::uint32_t joint : {c.joint_a, c.joint_b})
            if (tree_with[joint]) tree_with[joint]->may_divide = false;
    std::vector<std::uint8_t> damped(world.joints.size(), 0);
    for (std::uint32_t i = 0; i < world.joints.drives.size(); ++i) {
        const JointDrive& drive = world.joints.drives[i];
        if (Tree* tree = tree_with[drive.joint])
            tree->drives.push_back(i), tree->keeps_energy = false,
                                       tree->gives_none &= gives_none(drive);
        if (brakes(drive)) damped[drive.joint] = 1;
    }
    for (Tree& tree : trees_)
        tree.is_damped = std::all_of(tree.joints.begin(), tree.joints.end(),
                                     [&](std::uint32_t joint) { return damped[joint] != 0; });
    for (const std::uint32_t i : revolute_joints(world))
        if (tree_with[i]) tree_with[i]->revolute.push_back(i);
}

/// Returns the tree of each body, or none.
std::vector<DividedTrees::Tree*> DividedTrees::share_out_bodies(const World& world,
                                                                const Plan& plan) {
    std::vector<Tree*> tree_of(world.bodies.size(), nullptr);
    for (Tree& tree : trees_)
        for (const std::uint32_t i : tree.joints) {
            const Joint& joint = world.joints.joints[i];
            for (const std::uint32_t body : {joint.a, joint.b})
                if (body != kNoIndex && world.bodies.motion[body] == Motion::dynamic)
                    tree_of[body] = &tree;
        }
    const MotionLists all = sort_by_motion(world, plan.runs(Effect::gyroscopic));
    carries_momentum_.assign(world.bodies.size(), 0);
    for (const std::uint32_t body : all.gyroscopic) carries_momentum_[body] = 1;
    for (std::uint32_t body = 0; body < tree_of.size(); ++body) {
        if (!tree_of[body]) continue;
        MotionLists& motion = tree_of[body]->motion;
        tree_of[body]->bodies.push_back(body);
        (carries_momentum_[body] ? motion.gyroscopic : motion.plain).push_back(body);
    }
    for (Tree& tree : trees_)
        tree.pushed.reserve(tree.bodies.size()), tree.turned.reserve(tree.bodies.size());
    for (auto* list : {&rest_.plain, &rest_.gyroscopic, &rest_.scripted})
        list->reserve(world.bodies.size());
    return tree_of;
}

void DividedTrees::find_free(const World& world) {
    std::fill(touches_.begin(), touches_.end(), 0);
    for (const Contact& c : world.contacts.found) touches_[c.a] = touches_[c.b] = 1;
    const auto mark = [&](std::uint32_t body) { touches_[body] = 1; };
    world.each_body_among_particles(mark);
    world.each_linked_body(true, mark);
    for (Tree& tree : trees_)
        tree.is_free =
            tree.may_divide && std::none_of(tree.bodies.begin(), tree.bodies.end(),
                                            [&](std::uint32_t body) { return touches_[body]; });
}

/// Whether no body turns far, which is quickly seen and decides for most trees.
bool DividedTrees::turns_little(const Bodies& b, const Tree& tree, double h) {
    if (tree.has_lines) return false;
    double most = 0;
    for (const std::uint32_t body : tree.bodies)
        most = std::max(most, b.angular_velocity[body].squaredNorm());
    return h * h * most < kLittle * kLittle;
}

/// 0: none.
std::uint32_t DividedTrees::wanted_parts(const World& world, const Tree& tree, double h) {
    if (turns_little(world.bodies, tree, h)) return 0;
    const double turn = h * angular_rate(world, tree.joints);
    if (turn < kLittle) return 0;
    const double swing = std::sqrt(greatest_load(world, tree.joints, h));
    const double spin = h * eccentric_spin(world, tree.joints);
    return parts_for(std::max({turn / kTurn, spin / kSpin, swing < kHeavy ? swing / kSwing : 0}),
                     world.settings.tree_parts);
}

void DividedTrees::choose(World& world, double h) {
    for (Tree& tree : trees_) {
        TreePace& pace = world.joints.joints[tree.first].pace;
        const std::uint32_t before = pace.parts;
        if (!tree.is_free) {
            if (before > 1) take_back(world, tree.bodies, 0.5 * (h - h / before));
            pace = {};
            continue;
        }
        const std::uint32_t needed = wanted_parts(world, tree, h);
        if (needed >= before) {
            pace = {needed, before, 0};
        } else {
            const double calm_time = before > world.settings.tree_parts ? kSnapTime
                                     : tree.is_damped                   ? kDampedCalmTime
                                                                        : kCalmTime;
            const bool calm = ++pace.calm * h > calm_time;
            pace = {calm ? before / 2 : before, before, calm ? 0 : pace.calm};
        }
    }
}

/// Levers of what hangs by nothing must not change its angular momentum.
void DividedTrees::take_velocities(Bodies& bodies, const Tree& tree) {
    tree.solver.take_velocities(bodies);
    if (tree.drifts) turn_back(bodies, tree.bodies, tree.pushed);
}

/// What is past a limit is pushed back, which gives energy.
bool DividedTrees::is_past_limit(const World& world, const Tree& tree) {
    return std::any_of(tree.drives.begin(), tree.drives.end(), [&](std::uint32_t i) {
        const JointDrive& drive = world.joints.drives[i];
        if (drive.kind != DriveKind::limit) return false;
        const double q = joint_coordinate(world, drive.joint, drive.axis).value;
        return std::max(drive.spec.lower - q, q - drive.spec.upper) > kPastLimit;
    });
}

/// The energy_defect of a part that was just solved, of which only a gain is one where joints take
/// energy; 0 where it cannot be told.
double DividedTrees::defect_of(const World& world, const SubstepTime& time, double fall,
                               const Tree& tree) {
    if (fall != time.h || !tree.gives_none) return 0;
    if (!tree.keeps_energy && is_past_limit(world, tree)) return 0;
    const double unclosed = kFiner * world.settings.joint_tolerance * tree.joints.size();
    const TreeHold& hold = tree.holder.hold();
    const double defect = energy_defect(world, tree.bodies, time, fall, unclosed, hold,
                                        turning_work(world, tree.bodies, tree.pushed, hold));
    return tree.keeps_energy ? std::abs(defect) : std::max(0.0, defect);
}

/// What is not solved keeps such a share of its changes that it gains no more energy than it may.
void DividedTrees::bound_gain(World& world, double h, Tree& tree) const {
    Bodies& b = world.bodies;
    const TreeHold& hold = tree.holder.hold();
    EnergyLoan loan;
    loan.frame = hold.velocity;
    loan.granted = std::max(0.0, turning_work(world, tree.bodies, tree.pushed, hold));
    for (std::size_t k = 0; k < tree.bodies.size(); ++k) {
        const std::uint32_t i = tree.bodies[k];
        const Vector3d &v = tree.pushed[k], &w = tree.turned[k];
        loan.add_change(b, i, v, w, b.velocity[i] - v, b.angular_velocity[i] - w);
    }
    for (const std::uint32_t joint : tree.joints) loan.add_joint(world, joint, h);
    const double share = loan.share();
    for (const std::uint32_t joint : tree.joints)
        world.joints.joints[joint].owed =
            loan.owed_after(loan.gained_with(share)) / static_cast<double>(tree.joints.size());
    if (share == 1) return;
    tree.solver.keep_share(share);
    take_velocities(b, tree);
}

/// From where its bodies began. Returns whether the part can stand as it is, which the `last` try
/// has to unless it `may_snap`.
bool DividedTrees::try_part(World& world, const Plan& plan, const SubstepTime& time, double fall,
                            bool last, bool may_snap, Tree& tree) const {
    Bodies& b = world.bodies;
    for (const std::uint32_t body : tree.bodies) {
        b.velocity[body] = b.velocity_now[body];
        b.angular_velocity[body] = b.angular_velocity_now[body];
    }
    integrate_velocities(world, plan, tree.motion, time, fall);
    tree.pushed.clear(), tree.turned.clear();
    for (const std::uint32_t body : tree.bodies) {
        tree.pushed.push_back(b.velocity[body]);
        tree.turned.push_back(b.angular_velocity[body]);
    }
    tree.solver.load_impulses(world.joints);
    tree.solver.begin(world, time);
    const bool closes = tree.keeps_energy && fall == time.h;
    const TreeSolver<1>::Effort effort{.closes = closes, .follows = last};
    tree.solver.solve(effort);
    if (!tree.motion.gyroscopic.empty()) turn_as_free(b, time.h, effort, tree);
    take_velocities(b, tree);
    if (!last && !tree.solver.open().empty()) return false;
    const bool braked = tree.solver.took_levers_of_the_end();
    const double defect = braked ? 0 : defect_of(world, time, fall, tree);
    const bool followed = !braked && defect <= kDefect;
    if (!followed && may_snap) return false;
    tree.defect = std::max(tree.defect, defect);
    tree.is_coarse |= !followed && (braked || tree.defect > kCoarse);
    if (!followed || !tree.solver.open().empty()) bound_gain(world, time.h, tree);
    tree.solver.store_impulses(world.joints);
    return last || (time.h * angular_rate(world, tree.joints) <= kTooFar &&
                    time.h * eccentric_spin(world, tree.joints) <= kTooFast &&
                    time.h * greatest_jerk(world, tree.bodies, tree.joints) <= kJerk &&
                    greatest_angular_load(world, tree.joints, time.h) <= kTwist * kTwist);
}

/// Until the rates are those of free bodies with the momentum that the joints leave them: what
/// joints change of a momentum turns with the body, too.
void DividedTrees::turn_as_free(const Bodies& b, double h, TreeSolver<1>::Effort effort,
                                Tree& tree) const {
    for (int round = 0; round < kMostRounds; ++round) {
        const double change = tree.solver.correct_rates([&](std::uint32_t body, const Vector3d& w) {
            return carries_momentum_[body] ? pushed_rate(b, body, w, h)
                                           : Vector3d(b.angular_velocity[body] + w);
        });
        if (!(h * change > kSameTurn)) return;
        tree.solver.solve(effort);
    }
}

void DividedTrees::advance(World& world, const Plan& plan, double h, Tree& tree) const {
    TreePace& pace = world.joints.joints[tree.first].pace;
    if (tree.was_open) pace.parts = 2;
    std::uint32_t parts = std::max(pace.parts, 1u);
    double before = h / std::max(pace.before, 1u);
    tree.error = -1, tree.defect = 0, tree.is_coarse = false;
    for (std::uint32_t done = 0; done < parts; ++done) {
        if (done > 0) {
            remember_velocities(world.bodies, tree.bodies);
            count_turns(world, tree.revolute);
        }
        for (;; parts *= 2, done *= 2) {
            const bool fresh = world.settings.leapfrog_start && world.time == 0 && done == 0;
            const SubstepTime time{h / parts, fresh ? 0.5 : 1, world.time + done * (h / parts)};
            const double fall = fresh ? time.push() : 0.5 * (before + time.h);
            // the tables hold impulses of whole substeps
            scale_impulses(world.joints, tree.joints, tree.drives, fall / h);
            const std::uint32_t most = world.settings.tree_parts;
            if (tree.holder.moves()) {
                const double from = done * time.h;
                tree.holder.place(world.bodies, from, from + time.h, before);
            }
            const bool last = 2 * parts > most, may_snap = 2 * parts <= kSnap * most;
            const bool stands = try_part(world, plan, time, fall, last, may_snap, tree);
            scale_impulses(world.joints, tree.joints, tree.drives, h / fall);
            if (stands) break;
        }
        before = h / parts;
        move(world, tree.motion, before);
        for (const OpenTree& open : tree.solver.open())
            tree.error = std::max(tree.error, open.error);
    }
    if (tree.holder.moves()) tree.holder.take_back(world.bodies);
    if (parts > std::max(pace.parts, 1u)) pace = {parts, pace.before, 0};
    if (kDefectOfHalf * tree.defect > kDefect) pace.calm = 0;
}

const MotionLists& DividedTrees::advance(World& world, const Plan& plan, Workers& workers, double h,
                                         const MotionLists& all, StepReport& report) {
    const auto is_apart = [&](const Tree& tree) {
        return tree.was_open || world.joints.joints[tree.first].pace.is_divided();
    };
    bool any = false;
    for (Tree& tree : trees_) {
        auto& open = report.open_trees;
        const auto last = std::remove_if(open.begin(), open.end(), [&](const OpenTree& t) {
            return t.joint == tree.first && tree.is_free;
        });
        tree.was_open = last != open.end();
        open.erase(last, open.end());
        any |= is_apart(tree);
    }
    if (!any) return all;
    std::fill(moved_.begin(), moved_.end(), 0);
    for (Tree& tree : trees_) {
        if (!is_apart(tree)) continue;
        for (const std::uint32_t body : tree.bodies) moved_[body] = 1;
        tree.holder.begin(world, plan, h);
    }
    workers.run([&](std::uint32_t worker) {
        for (std::size_t i = 0; i < trees_.size(); ++i) {
            Tree& tree = trees_[i];
            const std::size_t turn = tree.holder.moves() ? tree.first_of_holder : i;
            if (turn % workers.count() == worker && is_apart(tree)) advance(world, plan, h, tree);
        }
    });
    for (const Tree& tree : trees_) {
        if (!is_apart(tree)) continue;
        if (tree.error >= 0) report.open_trees.push_back({tree.first, tree.error});
        report.coarse_trees += tree.is_coarse;
    }
    const auto leave = [&](const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& to) {
        to.clear();
        std::copy_if(from.begin(), from.end(), std::back_inserter(to),
                     [&](std::uint32_t body) { return !moved_[body]; });
    };
    leave(all.plain, rest_.plain), leave(all.gyroscopic, rest_.gyroscopic);
    leave(all.scripted, rest_.scripted);
    return rest_;
}

}  // namespace plumb
