// SPDX-License-Identifier: MIT
/// Bodies that joints hold together as a tree, closed by their poses: momentum stays, and no energy
/// is gained.
///
/// From the root on each body is turned and taken to where its joint is closed
/// (trees/joint_closing.h), however far that was open: nothing is sought, and nothing can fail. All
/// of what hangs by nothing is then shifted to where its centre of mass was, and on until it is no
/// deeper in what is immovable than before.
///
/// Velocities stay. What hangs by nothing is turned as one piece to the angular momentum that it
/// had (solve/free_turn.h). What that adds to its energy, or its height does, is taken from how the
/// bodies move against the piece as a whole (solve/rest_motion.h). Where that is too little, what
/// touches something immovable turns by less, and what flies is closed by less.
#pragma once

#include "solve/rigid_motion.h"
#include "world/world.h"

#include <cstdint>
#include <vector>

namespace plumb {

class TreePiece {
public:
    void reserve(std::size_t bodies) { members_.reserve(bodies); }

    void begin() { members_.clear(), obstacles_.clear(); }
    /// Parents before their children. `joint`: by which the body hangs; kNoIndex: by none, as only
    /// the first may.
    void add(const Bodies& bodies, std::uint32_t body, std::uint32_t joint);

    /// A contact with what is immovable.
    struct Obstacle {
        std::uint32_t member;  ///< by the order in which they were added
        Vector3d normal;       ///< towards that
        Vector3d arm;          ///< from its centre of mass [m]
        double gap;            ///< [m]
    };
    void add(const Obstacle& obstacle) { obstacles_.push_back(obstacle); }

    void close(World& world);

private:
    struct Pose {
        Vector3d position;
        Quaterniond orientation;
    };
    struct Member {
        std::uint32_t body, joint;
        Pose open, closed;
        Velocity<double> velocity;  ///< before all
    };

    bool is_held() const { return members_.front().joint != kNoIndex; }
    bool touches() const;
    void find_closed(World& world);
    void shift_back(const Bodies& bodies);
    void shift(const Vector3d& by);
    void take_poses(Bodies& bodies, double share) const;
    void keep_momentum(Bodies& bodies, const Vector3d& before) const;
    bool keep_energy(World& world, double before) const;
    void slow(Bodies& bodies, const RigidMotion& against, double kept) const;
    RigidMotion motion_of_holder(const World& world) const;
    double energy_against(const Bodies& bodies, const RigidMotion& motion) const;
    double lift(const World& world) const;
    Vector3d angular_momentum(const Bodies& bodies) const;

    std::vector<Member> members_;
    std::vector<Obstacle> obstacles_;
};

}  // namespace plumb
