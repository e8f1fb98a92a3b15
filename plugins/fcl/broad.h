// SPDX-License-Identifier: MIT
/// FCL's dynamic tree of boxes over our parts, kept from one search to the next. Parts without
/// bounds, half-spaces and height fields, are compared with everybody.
#pragma once

#include "manifold/body_table.h"

#include <memory>

namespace plumb::by_fcl {

class Tree {
public:
    Tree();
    ~Tree();

    /// Adds all pairs of parts whose fat bounds overlap and that are to be tested. Any order.
    void find_pairs(std::vector<PartPair>& pairs, const BodyTable& table);

private:
    struct Contents;
    std::unique_ptr<Contents> contents_;
};

}  // namespace plumb::by_fcl
