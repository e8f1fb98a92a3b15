// SPDX-License-Identifier: MIT
#include "bullet/broad.h"

#include "bullet/shapes.h"

#include <cmath>
#include <limits>

namespace plumb::bullet {
namespace {

/// Rounded to Bullet's precision, never up.
btScalar bt_below(double x) {
    const btScalar near = bt(x);
    return near > x ? std::nextafter(near, -std::numeric_limits<btScalar>::infinity()) : near;
}
btVector3 bt_below(Vec3 v) { return {bt_below(v.x), bt_below(v.y), bt_below(v.z)}; }

btDbvtVolume volume_of(const Aabb& b) {
    return btDbvtVolume::FromMM(bt_below(b.low), -bt_below(-b.high));
}

/// Takes the tree's candidates; its volumes may be stale, so bounds are compared again.
struct Meet : btDbvt::ICollide {
    std::vector<PartPair>& pairs;
    const BodyTable& table;
    Meet(std::vector<PartPair>& p, const BodyTable& t) : pairs(p), table(t) {}

    void meet(std::uint32_t i, std::uint32_t j) {
        const Part &a = table.parts()[i], &b = table.parts()[j];
        if (overlap(a.fat, b.fat) && table.wanted(a, b))
            pairs.push_back({std::min(i, j), std::max(i, j)});
    }
    void Process(const btDbvtNode* p, const btDbvtNode* q) override {
        meet(static_cast<std::uint32_t>(p->dataAsInt), static_cast<std::uint32_t>(q->dataAsInt));
    }
};

}  // namespace

void Tree::refill(const BodyTable& table) {
    tree_.clear();
    leaves_.assign(table.parts().size(), nullptr);
    version_ = table.version();
}

void Tree::update(const BodyTable& table) {
    unbounded_.clear();
    for (std::uint32_t i = 0; i < leaves_.size(); ++i) {
        const Part& part = table.parts()[i];
        btDbvtNode*& leaf = leaves_[i];
        const bool bounded = part.present && finite(part.bounds.low) && finite(part.bounds.high);
        if (part.present && !bounded) unbounded_.push_back(i);
        if (!bounded) {
            if (leaf) tree_.remove(leaf);
            leaf = nullptr;
            continue;
        }
        // A leaf is a little larger than its part, so that small motions leave the tree as it is.
        btDbvtVolume volume = volume_of(part.fat);
        const double spare = 0.02 * (part.fat.high.y - part.fat.low.y) + 1e-6;
        if (leaf) {
            tree_.update(leaf, volume, spare);
            continue;
        }
        volume.Expand(bt(Vec3{spare, spare, spare}));
        leaf = tree_.insert(volume, nullptr);
        leaf->dataAsInt = static_cast<int>(i);
    }
    tree_.optimizeIncremental(1 + static_cast<int>(leaves_.size()) / 100);
}

void Tree::find_pairs(std::vector<PartPair>& pairs, const BodyTable& table) {
    if (version_ != table.version()) refill(table);
    update(table);
    Meet meet(pairs, table);
    if (tree_.m_root) tree_.collideTTpersistentStack(tree_.m_root, tree_.m_root, meet);
    for (std::uint32_t i : unbounded_)
        for (std::uint32_t j = 0; j < leaves_.size(); ++j)
            if (leaves_[j]) meet.meet(i, j);
}

}  // namespace plumb::bullet
