// SPDX-License-Identifier: MIT
/// Trees of joints that whirl in contact, closed once they have moved (trees/tree_piece.h).
///
/// What turns far within a substep does not come to where its joints were solved for: contacts,
/// which have the last word over them, ask for velocities that are right for small turns alone,
/// some trees have no solution near, and a body beyond half a radian turns as a free one does
/// (math/free_rotation.h).
#pragma once

#include "effects/plan.h"
#include "schedule/joint_forest.h"
#include "trees/tree_piece.h"
#include "world/world.h"

#include <cstdint>
#include <vector>

namespace plumb {

class WhirledTrees {
public:
    WhirledTrees(const World& world, const Plan& plan);

    /// After the move of a substep of h [s].
    void close(World& world, double h);

private:
    struct Node {
        std::uint32_t body, joint;  ///< kNoIndex: it hangs by none
        std::int32_t parent;        ///< in nodes_, or as ForestNode::parent
        std::uint32_t root = 0;     ///< of its piece: broken joints divide a tree
    };
    struct Range {
        std::uint32_t first, last;
    };

    static std::vector<std::uint8_t> tied_otherwise(const World& world, const JointForest& forest);
    void add(const World& world, const JointForest& tree);
    bool whirls(const Bodies& bodies, const Range& tree, double h) const;
    bool is_open(const World& world, const Range& tree) const;
    void find_neighbours(const World& world);
    bool has_any(const Range& tree, const std::vector<std::uint8_t>& marks) const;
    void find_pieces(const World& world, const Range& tree);
    void close(World& world, const Range& tree, std::uint32_t root, double h);
    void add_obstacles(const World& world, double h);
    void add_obstacle(const World& world, std::size_t contact, double h);

    std::vector<Node> nodes_;  ///< parents before their children
    std::vector<Range> trees_;
    std::vector<std::uint8_t> among_particles_, in_contact_;  ///< [body] once a tree is open
    std::vector<std::uint32_t> place_;                        ///< [body] in piece_, or kNoIndex
    TreePiece piece_;
};

}  // namespace plumb
