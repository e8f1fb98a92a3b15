// SPDX-License-Identifier: MIT
#include "fcl/broad.h"

#include "fcl/shapes.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

namespace plumb::by_fcl {
namespace {

/// A part in FCL's tree, with the bounds that the table made rather than FCL's own.
class Leaf : public fcl::CollisionObjectd {
public:
    Leaf(const Part& part, std::uint32_t index)
        : fcl::CollisionObjectd(geometry_of(part).shape), part_index(index) {}

    /// Whether they changed.
    bool set_bounds(const Aabb& b) {
        const fcl::AABBd fresh(to_fcl(b.low), to_fcl(b.high));
        if (in_tree && aabb.equal(fresh)) return false;
        aabb = fresh;
        return true;
    }

    const std::uint32_t part_index;
    bool in_tree = false;
};

struct Meeting {
    std::vector<PartPair>& pairs;
    const BodyTable& table;

    void meet(std::uint32_t i, std::uint32_t j) {
        const Part &a = table.parts()[i], &b = table.parts()[j];
        if (overlap(a.fat, b.fat) && table.wanted(a, b))
            pairs.push_back({std::min(i, j), std::max(i, j)});
    }
};

/// FCL's call for two leaves whose boxes overlap; false lets it go on.
bool take_pair(fcl::CollisionObjectd* p, fcl::CollisionObjectd* q, void* meeting) {
    static_cast<Meeting*>(meeting)->meet(static_cast<Leaf*>(p)->part_index,
                                         static_cast<Leaf*>(q)->part_index);
    return false;
}

}  // namespace

struct Tree::Contents {
    void refill(const BodyTable& table);
    void update(const BodyTable& table);

    fcl::DynamicAABBTreeCollisionManagerd manager;
    std::vector<std::unique_ptr<Leaf>> leaves;  ///< [part], none where one is vacant
    std::vector<fcl::CollisionObjectd*> moved, fresh;
    std::vector<std::uint32_t> unbounded;  ///< parts that are present
    std::uint64_t version = ~std::uint64_t{0};
};

void Tree::Contents::refill(const BodyTable& table) {
    manager.clear();
    leaves.clear();
    for (std::uint32_t i = 0; i < table.parts().size(); ++i) {
        const Part& part = table.parts()[i];
        leaves.push_back(part.vacant ? nullptr : std::make_unique<Leaf>(part, i));
    }
    version = table.version();
}

void Tree::Contents::update(const BodyTable& table) {
    moved.clear();
    fresh.clear();
    unbounded.clear();
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
        const Part& part = table.parts()[i];
        Leaf* leaf = leaves[i].get();
        if (!leaf) continue;
        const bool bounded = finite(part.fat.low) && finite(part.fat.high);
        if (part.present && !bounded) unbounded.push_back(i);
        if (part.present && bounded) {
            if (leaf->set_bounds(part.fat)) (leaf->in_tree ? moved : fresh).push_back(leaf);
            leaf->in_tree = true;
        } else if (leaf->in_tree) {
            manager.unregisterObject(leaf);
            leaf->in_tree = false;
        }
    }
    manager.registerObjects(fresh);
    manager.update(moved);
}

Tree::Tree() : contents_(std::make_unique<Contents>()) {}
Tree::~Tree() = default;

void Tree::find_pairs(std::vector<PartPair>& pairs, const BodyTable& table) {
    Contents& c = *contents_;
    if (c.version != table.version()) c.refill(table);
    c.update(table);
    Meeting meeting{pairs, table};
    c.manager.collide(&meeting, take_pair);
    for (std::uint32_t i : c.unbounded)
        for (const auto& leaf : c.leaves)
            if (leaf && leaf->in_tree) meeting.meet(i, leaf->part_index);
}

}  // namespace plumb::by_fcl
