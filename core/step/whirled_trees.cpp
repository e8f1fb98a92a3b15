// SPDX-License-Identifier: MIT
#include "step/whirled_trees.h"

#include "math/rotation.h"
#include "schedule/joint_trees.h"
#include "ties/joint_state.h"

#include <algorithm>

namespace plumb {
namespace {

/// A body whirls that turns farther than this within the substep [rad].
constexpr double kWhirl = 0.1;

/// A joint is open by more than so many tolerances: less is closed in the next substep.
constexpr double kOpen = 100;

bool is_within(const Vector3d& rate, double most) { return rate.squaredNorm() <= most * most; }

}  // namespace

WhirledTrees::WhirledTrees(const World& world, const Plan& plan) {
    if (!plan.runs(Effect::joint_trees)) return;
    const JointForest forest = find_forest(world);
    const auto roots = std::count_if(forest.nodes.begin(), forest.nodes.end(),
                                     [](const ForestNode& node) { return node.parent < 0; });
    const std::vector<std::uint8_t> tied = tied_otherwise(world, forest);
    std::size_t largest = 0;
    for (const JointForest& tree : share_out_trees(forest, static_cast<std::uint32_t>(roots))) {
        const bool may_close = std::none_of(
            tree.nodes.begin(), tree.nodes.end(),
            [&](const ForestNode& node) { return tied[world.body_of_row[node.row]] != 0; });
        if (!may_close) continue;
        add(world, tree);
        largest = std::max(largest, tree.nodes.size());
    }
    piece_.reserve(largest);
    among_particles_.resize(world.bodies.size());
    in_contact_.resize(world.bodies.size());
    place_.resize(world.bodies.size(), kNoIndex);
}

void WhirledTrees::add(const World& world, const JointForest& tree) {
    const auto first = static_cast<std::uint32_t>(nodes_.size());
    for (const ForestNode& from : tree.nodes) {
        const std::int32_t parent =
            from.parent < 0 ? from.parent : from.parent + static_cast<std::int32_t>(first);
        nodes_.push_back(
            {world.body_of_row[from.row], from.parent == kFree ? kNoIndex : from.joint, parent});
    }
    trees_.push_back({first, static_cast<std::uint32_t>(nodes_.size())});
}

/// [body] whether loops or links have a say in where it is, too.
std::vector<std::uint8_t> WhirledTrees::tied_otherwise(const World& world,
                                                       const JointForest& forest) {
    std::vector<std::uint8_t> tied(world.bodies.size(), 0);
    const auto mark = [&](std::uint32_t body) {
        if (body != kNoIndex) tied[body] = 1;
    };
    for (std::uint32_t i = 0; i < world.joints.size(); ++i) {
        const Joint& joint = world.joints.joints[i];
        if (!forest.in_tree[i] && !joint.broken) mark(joint.a), mark(joint.b);
    }
    world.each_linked_body(true, mark);
    return tied;
}

void WhirledTrees::close(World& world, double h) {
    bool any = false;
    for (const Range& tree : trees_) {
        if (!whirls(world.bodies, tree, h) || !is_open(world, tree)) continue;
        if (!any) find_neighbours(world);
        any = true;
        if (has_any(tree, among_particles_) || !has_any(tree, in_contact_)) continue;
        find_pieces(world, tree);
        for (std::uint32_t root = tree.first; root < tree.last; ++root)
            if (nodes_[root].root == root) close(world, tree, root, h);
    }
}

/// By the rates at the start or at the end of the substep.
bool WhirledTrees::whirls(const Bodies& b, const Range& tree, double h) const {
    const double most = kWhirl / h;
    return !std::all_of(nodes_.begin() + tree.first, nodes_.begin() + tree.last,
                        [&](const Node& node) {
                            return is_within(b.angular_velocity[node.body], most) &&
                                   is_within(b.angular_velocity_now[node.body], most);
                        });
}

bool WhirledTrees::is_open(const World& world, const Range& tree) const {
    const Bodies& b = world.bodies;
    const double most = kOpen * world.settings.joint_tolerance;
    return std::any_of(
        nodes_.begin() + tree.first, nodes_.begin() + tree.last, [&](const Node& node) {
            if (node.joint == kNoIndex) return false;
            const Joint& joint = world.joints.joints[node.joint];
            return (!(joint.compliance > 0) && joint_gap(b, joint) > most) ||
                   (!(joint.angular_compliance > 0) && joint_turn_gap(b, joint) > most);
        });
}

/// What deforms is solved with the bodies that it touches, where they were. What is near nothing
/// closes with the next substep, and better: tops and gyroscopes precess by their law.
void WhirledTrees::find_neighbours(const World& world) {
    std::fill(among_particles_.begin(), among_particles_.end(), 0);
    world.each_body_among_particles([&](std::uint32_t body) { among_particles_[body] = 1; });
    std::fill(in_contact_.begin(), in_contact_.end(), 0);
    for (const Contact& c : world.contacts.found) in_contact_[c.a] = in_contact_[c.b] = 1;
}

bool WhirledTrees::has_any(const Range& tree, const std::vector<std::uint8_t>& marks) const {
    return std::any_of(nodes_.begin() + tree.first, nodes_.begin() + tree.last,
                       [&](const Node& node) { return marks[node.body] != 0; });
}

void WhirledTrees::find_pieces(const World& world, const Range& tree) {
    for (std::uint32_t n = tree.first; n < tree.last; ++n) {
        Node& node = nodes_[n];
        const bool hangs = node.parent >= 0 && !world.joints.joints[node.joint].broken;
        node.root = hangs ? nodes_[static_cast<std::size_t>(node.parent)].root : n;
    }
}

void WhirledTrees::close(World& world, const Range& tree, std::uint32_t root, double h) {
    std::uint32_t count = 0;
    piece_.begin();
    for (std::uint32_t n = root; n < tree.last; ++n) {
        const Node& node = nodes_[n];
        if (node.root != root) continue;
        const bool hangs = node.joint != kNoIndex && !world.joints.joints[node.joint].broken;
        piece_.add(world.bodies, node.body, hangs ? node.joint : kNoIndex);
        place_[node.body] = count++;
    }
    add_obstacles(world, h);
    for (std::uint32_t n = root; n < tree.last; ++n) place_[nodes_[n].body] = kNoIndex;
    piece_.close(world);
}

void WhirledTrees::add_obstacles(const World& world, double h) {
    const std::vector<Motion>& motion = world.bodies.motion;
    for (std::size_t k = 0; k < world.contacts.found.size(); ++k) {
        const Contact& c = world.contacts.found[k];
        const bool moves = motion[c.a] == Motion::dynamic && motion[c.b] == Motion::dynamic;
        if (!moves && (place_[c.a] != kNoIndex || place_[c.b] != kNoIndex))
            add_obstacle(world, k, h);
    }
}

/// The contact's point has ridden on the body of the piece.
void WhirledTrees::add_obstacle(const World& world, std::size_t k, double h) {
    const Contact& c = world.contacts.found[k];
    const Bodies& b = world.bodies;
    const bool is_a = place_[c.a] != kNoIndex;
    const std::uint32_t body = is_a ? c.a : c.b, other = is_a ? c.b : c.a;
    const Vector3d normal = (is_a ? 1 : -1) * to_eigen(c.normal), &point = world.contacts.point[k];
    const auto came_to = [&](std::uint32_t i) -> Vector3d {
        const Vector3d arm = point - (b.position[i] - h * b.velocity[i]);
        return b.position[i] + unit_exponential<double>(h * b.angular_velocity[i]) * arm;
    };
    const Vector3d own = came_to(body);
    const double gap = world.contacts.gap[k] + normal.dot(own - came_to(other));
    piece_.add({place_[body], normal, own - b.position[body], gap});
}

}  // namespace plumb
