// SPDX-License-Identifier: MIT
/// Bullet's tree of bounding volumes over our parts. Parts without bounds, half-spaces and height
/// fields, meet everybody.
#pragma once

#include "manifold/body_table.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

namespace plumb::bullet {

class Tree {
public:
    /// Adds all pairs of parts whose bounds overlap and that are to be tested.
    void find_pairs(std::vector<PartPair>& pairs, const BodyTable& table);

private:
    void refill(const BodyTable& table);
    void update(const BodyTable& table);

    btDbvt tree_;
    std::vector<btDbvtNode*> leaves_;       ///< [part], nullptr: unbounded or absent
    std::vector<std::uint32_t> unbounded_;  ///< parts
    std::uint64_t version_ = ~std::uint64_t{0};
};

}  // namespace plumb::bullet
