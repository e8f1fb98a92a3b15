// SPDX-License-Identifier: MIT
/// Joints of one precision and lane width: from the world's tables to blocks, iterations, and back.
#pragma once

#include "kernels/body_columns.h"
#include "schedule/joint_forest.h"
#include "solve/constraint_group.h"
#include "solve/lane_blocks.h"
#include "solve/velocity_table.h"
#include "step/coupling_solver.h"
#include "ties/drive_state.h"
#include "world/tie.h"

#include <algorithm>
#include <vector>

namespace plumb {

template <class Real, int W>
class JointSolver final : public ConstraintGroup<Real> {
public:
    /// `elsewhere` [joint]: 1 where a joint, with what drives it, is solved by another;
    /// `in_islands`: the same in this step.
    JointSolver(const World& world, const std::vector<std::uint8_t>& elsewhere,
                const SolvedTies& in_islands, Workers& workers)
        : kernels_(joint_kernels<Real, W>()),
          in_island_(in_islands.joints),
          workers_(workers),
          couplings_(in_islands.couplings) {
        lay_out(world, elsewhere);
    }

    Stage stage() const override { return Stage::joints; }
    bool empty() const override { return idle_; }

    /// Arms, errors and masses at the start of a substep. Impulses start from nothing: those of the
    /// substep before point where the bodies were, and chains that swing gain energy from them.
    void begin(const World& world, const BodyRows<Real>&, const PassSettings<Real>&,
               double h) override {
        look_for_work(world.joints);
        if (idle_) return;
        begin_balls(world, h);
        for (std::size_t i = 0; i < block_joints_.size(); ++i)
            fill_block(world, world.joints.joints[block_joints_[i]], i, h);
        fill_drives(world, h);
        couplings_.begin(world, h);
    }

    /// One iteration from the roots of the trees outwards. What holds the bodies together has the
    /// last word over what drives them.
    void iterate_positions(const BodyRows<Real>& bodies, const PassSettings<Real>& pass,
                           std::uint32_t worker) override {
        const Real h = pass.h;
        if (!couplings_.empty()) {
            if (worker == 0) couplings_.solve(bodies);
            workers_.barrier();
        }
        drives_.iterate(kernels_.drives, bodies, h, workers_, worker);
        balls_.iterate(kernels_.balls, bodies, h, workers_, worker);
        blocks_.iterate(kernels_.joints, bodies, h, workers_, worker);
    }

    bool has_residuals() const override { return !idle_; }
    void add_residuals(IslandResiduals& islands, const World&, const BodyRows<Real>& bodies,
                       const PassSettings<Real>& pass) override {
        if (idle_) return;
        balls_.add_residuals(islands, kernels_.ball_residuals, bodies, pass.h,
                             [&](std::size_t i) { return !in_island_[ball_joints_[i]]; });
        blocks_.add_residuals(islands, kernels_.joint_residuals, bodies, pass.h,
                              [&](std::size_t i) { return !in_island_[block_joints_[i]]; });
        drives_.add_residuals(
            islands, kernels_.drive_residuals, bodies, pass.h,
            [&](std::size_t i) { return drives_.block(i).mass[drives_.lane(i)] > 0; });
    }

    void end_substep(World& world) override {
        if (idle_) return;
        JointTable& table = world.joints;
        for (const std::uint32_t i : driven_)
            if (!in_island_[table.drives[i].joint])
                table.drives[i].impulse_before = table.drives[i].impulse;
        for (std::size_t i = 0; i < ball_joints_.size(); ++i) {
            if (in_island_[ball_joints_[i]]) continue;
            Joint& joint = table.joints[ball_joints_[i]];
            auto& rows = joint.rows;
            joint.rows_before = rows;
            const std::uint32_t lane = balls_.lane(i);
            for (int k = 0; k < 3; ++k) rows[k] = double(balls_.block(i).impulse[k][lane]);
        }
        for (std::size_t i = 0; i < block_joints_.size(); ++i) {
            if (in_island_[block_joints_[i]]) continue;
            Joint& joint = table.joints[block_joints_[i]];
            joint.rows_before = joint.rows;
            for (int k = 0; k < 6; ++k)
                joint.rows[k] = double(blocks_.block(i).lambda[k][blocks_.lane(i)]);
        }
        for (std::size_t i = 0; i < driven_.size(); ++i) {
            JointDrive& drive = table.drives[driven_[i]];
            if (!in_island_[drive.joint])
                drive.impulse = double(drives_.block(i).lambda[drives_.lane(i)]);
        }
        couplings_.store_impulses(table);
    }

private:
    /// Islands may give a joint up in the middle of a step.
    void look_for_work(const JointTable& table) {
        const auto is_elsewhere = [&](std::uint32_t joint) { return in_island_[joint] != 0; };
        const auto is_driven_elsewhere = [&](std::uint32_t drive) {
            return is_elsewhere(table.drives[drive].joint);
        };
        idle_ = std::all_of(ball_joints_.begin(), ball_joints_.end(), is_elsewhere) &&
                std::all_of(block_joints_.begin(), block_joints_.end(), is_elsewhere) &&
                std::all_of(driven_.begin(), driven_.end(), is_driven_elsewhere) &&
                couplings_.all_in_island();
    }

    void begin_balls(const World& world, double h) {
        const auto& joints = world.joints.joints;
        for (std::size_t i = 0; i < ball_joints_.size(); ++i) {
            BallFrames<W>& frames = frames_[balls_.index(i)];
            frames.used[balls_.lane(i)] = !in_island_[ball_joints_[i]];
            frames.load[balls_.lane(i)] =
                load_of(joints[ball_joints_[i]], kAlongX, JointSolve::iterations);
        }
        kernels_.begin_balls(balls_.data(), frames_.data(), states_of(world.bodies), h,
                             frames_.size());
    }

    static std::int32_t row_of(const World& world, std::uint32_t body) {
        return body == kNoIndex ? world.zero_row() : world.bodies.row[body];
    }
    static BodyPair pair_of(const World& world, const Joint& joint, std::uint32_t item) {
        return {row_of(world, joint.a), row_of(world, joint.b), item, 1, 0};
    }

    /// One that broke keeps its place, so that the others keep theirs.
    static bool is_laid_out(const World& world, const Joint& joint) {
        return joint.broken || world.acts(joint);
    }

    void lay_out(const World& world, const std::vector<std::uint8_t>& elsewhere) {
        std::vector<BodyPair> all, balls, blocks, drives;
        for (std::uint32_t i = 0; i < world.joints.size(); ++i)
            all.push_back(pair_of(world, world.joints.joints[i], i));
        find_joint_levels(all, world.dynamic_count);
        for (std::uint32_t i = 0; i < world.joints.size(); ++i) {
            const Joint& joint = world.joints.joints[i];
            if (elsewhere[i] || !is_laid_out(world, joint)) continue;
            if (joint.is_plain_ball()) {
                ball_joints_.push_back(i);
                balls.push_back(all[i]);
            } else if (joint.locked != decltype(joint.locked){}) {
                block_joints_.push_back(i);
                blocks.push_back(all[i]);
            }
        }
        for (std::uint32_t i = 0; i < world.joints.drives.size(); ++i) {
            const std::uint32_t joint = world.joints.drives[i].joint;
            if (elsewhere[joint] || !is_laid_out(world, world.joints.joints[joint])) continue;
            driven_.push_back(i);
            drives.push_back(all[joint]);
        }
        balls_.lay_out(balls, world);
        blocks_.lay_out(blocks, world);
        drives_.lay_out(drives, world);
        frames_.assign(balls_.block_count(), BallFrames<W>{});
        for (std::size_t i = 0; i < ball_joints_.size(); ++i)
            place_ball(world.joints.joints[ball_joints_[i]], i);
    }

    static void put(Real (&to)[3][W], std::uint32_t lane, const Vector3d& v) {
        for (int k = 0; k < 3; ++k) to[k][lane] = static_cast<Real>(v[k]);
    }

    /// Where the balls' points are on their bodies.
    void place_ball(const Joint& joint, std::size_t item) {
        BallFrames<W>& frames = frames_[balls_.index(item)];
        const std::uint32_t lane = balls_.lane(item);
        frames.held[lane] = joint.b == kNoIndex;
        frames.body_a[lane] = joint.a;
        frames.body_b[lane] = joint.b == kNoIndex ? joint.a : joint.b;
        for (int k = 0; k < 3; ++k) {
            frames.point_a[k][lane] = joint.frame_a.position[k];
            frames.point_b[k][lane] = joint.frame_b.position[k];
        }
    }

    void fill_block(const World& world, const Joint& joint, std::size_t item, double h) {
        const bool in_island = in_island_[block_joints_[item]] != 0;
        JointBlock<Real, W>& block = blocks_.block(item);
        const std::uint32_t lane = blocks_.lane(item);
        const JointGeometry<double> g =
            loaded_joint_geometry(world, joint, JointSolve::iterations, substep_time(world, h));
        blocks_.fill_masses(item, world.bodies, joint.a, joint.b);
        put(block.arm_a, lane, g.r_a), put(block.arm_b, lane, g.r_b);
        put(block.apart, lane, g.apart);
        for (int k = 0; k < 3; ++k)
            put(block.e[k], lane, g.e[k]), put(block.u[k], lane, g.u[k]),
                put(block.w[k], lane, g.w[k]);
        for (std::uint32_t k = 0; k < kJointAxes; ++k) {
            block.lock[k][lane] = static_cast<Real>(in_island ? 0 : g.lock[k]);
            block.softness[k][lane] = static_cast<Real>(g.softness[k]);
            block.lag[k][lane] = static_cast<Real>(g.lag[k]);
            block.lambda[k][lane] = 0;
        }
        block.share_a[lane] = static_cast<Real>(g.lever_a.share);
        block.share_b[lane] = static_cast<Real>(g.lever_b.share);
        put(block.lag_a, lane, g.lever_a.lag), put(block.lag_b, lane, g.lever_b.lag);
        block.line_share[lane] = static_cast<Real>(g.line_share);
        put(block.line_lag, lane, g.line_lag);
        block.length[lane] = static_cast<Real>(g.length);
    }

    /// Drives stand by joint and axis, so that their geometry and coordinates are made once.
    void fill_drives(const World& world, double h) {
        std::uint32_t joint = kNoIndex;
        JointGeometry<double> geometry;
        const JointDrive* before = nullptr;
        JointCoordinate q;
        for (std::size_t i = 0; i < driven_.size(); ++i) {
            const JointDrive& drive = world.joints.drives[driven_[i]];
            if (drive.is_spring() && drive.joint != joint) {
                joint = drive.joint;
                geometry =
                    joint_geometry(world, world.joints.joints[joint], substep_time(world, h));
            }
            if (!before || before->joint != drive.joint || before->axis != drive.axis)
                q = joint_coordinate(world, drive.joint, drive.axis);
            fill_drive(world, drive, q, geometry, i, h);
            before = &drive;
        }
    }

    /// `q`: of its joint along or about its axis; `geometry`: of the joint, where the drive is a
    /// spring.
    void fill_drive(const World& world, const JointDrive& drive, const JointCoordinate& q,
                    const JointGeometry<double>& geometry, std::size_t item, double h) {
        const Joint& joint = world.joints.joints[drive.joint];
        const double k = row_response(q, inverse_mass(world.bodies, joint.a),
                                      inverse_mass(world.bodies, joint.b));
        const double mass = drive.is_spring() ? driven_mass(world, joint, geometry, q) : 0;
        const DriveRow row = drive_row(world, drive, q, mass, substep_time(world, h));
        DriveBlock<Real, W>& block = drives_.block(item);
        const std::uint32_t lane = drives_.lane(item);
        drives_.fill_masses(item, world.bodies, joint.a, joint.b);
        put(block.along, lane, q.along);
        put(block.turn_a, lane, q.turn_a), put(block.turn_b, lane, q.turn_b);
        block.bias[lane] = static_cast<Real>(row.bias);
        block.softness[lane] = static_cast<Real>(row.softness);
        const bool acts = k > 0 && !joint.broken && !in_island_[drive.joint];
        block.mass[lane] = static_cast<Real>(acts ? 1 / (k + row.softness) : 0);
        block.lowest[lane] = static_cast<Real>(row.lowest);
        block.highest[lane] = static_cast<Real>(row.highest);
        block.lambda[lane] = 0;
    }

    const JointKernels<Real, W>& kernels_;
    const std::vector<std::uint8_t>& in_island_;
    Workers& workers_;
    std::vector<std::uint32_t> ball_joints_, block_joints_;  ///< index into JointTable::joints
    std::vector<std::uint32_t> driven_;                      ///< index into JointTable::drives
    bool idle_ = false;  ///< exact islands solve all of them in this substep
    LaneBlocks<BallBlock<Real, W>, Real, W> balls_;
    std::vector<BallFrames<W>> frames_;  ///< [block of balls_]
    LaneBlocks<JointBlock<Real, W>, Real, W> blocks_;
    LaneBlocks<DriveBlock<Real, W>, Real, W> drives_;
    CouplingSolver<Real> couplings_;
};

}  // namespace plumb
