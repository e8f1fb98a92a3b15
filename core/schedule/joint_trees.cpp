// SPDX-License-Identifier: MIT
#include "schedule/joint_trees.h"

#include "world/sleep.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace plumb {
namespace {

/// Bodies that move have the first rows; all that does not, the one behind them.
struct BodyRowsOf {
    std::vector<std::int32_t> row;  // [body]
    std::int32_t count = 0;         // of those that move

    BodyRowsOf(const World& world, bool asleep_too) {
        const auto moves = [&](Motion m) {
            return asleep_too ? is_movable(m) : m == Motion::dynamic;
        };
        for (const Motion motion : world.bodies.motion) count += moves(motion);
        std::int32_t next = 0;
        for (const Motion motion : world.bodies.motion)
            row.push_back(moves(motion) ? next++ : count);
    }
    std::int32_t of(std::uint32_t body) const { return body == kNoIndex ? count : row[body]; }
};

/// A joint's bodies as rows, and how many rows it takes away.
BodyPair joined_pair(const World& world, const BodyRowsOf& rows, std::uint32_t index) {
    const Joint& joint = world.joints.joints[index];
    const auto locked = std::count(joint.locked.begin(), joint.locked.end(), true);
    const std::int32_t a = rows.of(joint.a), b = rows.of(joint.b);
    const bool acts = !joint.broken && std::min(a, b) < rows.count;
    return {a, b, index, acts ? static_cast<std::uint32_t>(locked) : 0};
}

/// Sets of dynamic bodies that joints link.
class JointIslands {
public:
    JointIslands(const std::vector<BodyPair>& joints, std::int32_t dynamic_count)
        : of_(static_cast<std::size_t>(dynamic_count) + 1) {
        std::iota(of_.begin(), of_.end(), 0);
        for (const BodyPair& j : joints)
            if (j.row_a < dynamic_count && j.row_b < dynamic_count)
                of_[root(j.row_a)] = root(j.row_b);
    }

    /// That of a joint, named by one of its bodies. All that sleep are of one behind the others.
    std::int32_t of(const BodyPair& joint) {
        const auto none = static_cast<std::int32_t>(of_.size()) - 1;
        return root(std::min({joint.row_a, joint.row_b, none}));
    }
    std::int32_t root(std::int32_t row) {
        while (of_[row] != row) row = of_[row] = of_[of_[row]];
        return row;
    }

private:
    std::vector<std::int32_t> of_;
};

/// What speaks for and against solving an island as a tree.
struct Census {
    std::uint32_t bodies = 0, joints = 0, couplings = 0;
    bool held = false, driven = false, has_motors = false;

    bool has_many_loops() const {
        const std::uint32_t edges = bodies - (held ? 0 : 1);
        return 10 * (joints - std::min(joints, edges)) > joints;
    }
    /// Passive ragdolls, which fall about: their limits hold as well by iterations, for a tenth of
    /// the time, and it does not matter that friction under load creeps.
    bool is_passive_ragdoll() const {
        return !held && driven && !has_motors && bodies <= kMostOfARagdoll;
    }
    bool suits_trees() const {
        return !is_mostly_coupled(couplings, joints) && !has_many_loops() && !is_passive_ragdoll();
    }

    static constexpr std::uint32_t kMostOfARagdoll = 32;
};

std::vector<Census> take_census(const World& world, std::int32_t dynamic_count,
                                const std::vector<BodyPair>& joints, JointIslands& islands) {
    std::vector<Census> census(static_cast<std::size_t>(dynamic_count) + 1);
    for (std::int32_t row = 0; row < dynamic_count; ++row) ++census[islands.root(row)].bodies;
    for (const BodyPair& j : joints) {
        Census& c = census[islands.of(j)];
        c.joints += j.count > 0;
        c.held |= j.count > 0 && std::max(j.row_a, j.row_b) >= dynamic_count;
    }
    for (const JointDrive& d : world.joints.drives) {
        Census& c = census[islands.of(joints[d.joint])];
        c.driven = true, c.has_motors |= d.kind == DriveKind::motor;
    }
    for (const JointCoupling& c : world.joints.couplings) {
        const std::int32_t a = islands.of(joints[c.joint_a]), b = islands.of(joints[c.joint_b]);
        ++census[a].couplings;
        if (b != a) ++census[b].couplings;
    }
    return census;
}

void leave_out_what_is_iterated(const World& world, std::int32_t dynamic_count,
                                std::vector<BodyPair>& joints) {
    JointIslands islands(joints, dynamic_count);
    const std::vector<Census> census = take_census(world, dynamic_count, joints, islands);
    for (BodyPair& j : joints)
        if (!census[islands.of(j)].suits_trees()) j.count = 0;
}

}  // namespace

JointForest find_forest(const World& world, bool asleep_too) {
    const BodyRowsOf rows(world, asleep_too);
    std::vector<BodyPair> joints;
    for (std::uint32_t i = 0; i < world.joints.size(); ++i)
        joints.push_back(joined_pair(world, rows, i));
    if (world.settings.joints == JointMethod::auto_)
        leave_out_what_is_iterated(world, rows.count, joints);
    return grow_joint_forest(joints, rows.count);
}

}  // namespace plumb
