// SPDX-License-Identifier: MIT
/// What is left of a deformable's elements.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace plumb {

/// Elements without those of some indices, which are sorted.
template <class Element>
std::vector<Element> elements_left(const std::vector<Element>& elements,
                                   const std::vector<std::uint32_t>& gone) {
    std::vector<Element> left;
    for (std::uint32_t i = 0; i < elements.size(); ++i)
        if (!std::binary_search(gone.begin(), gone.end(), i)) left.push_back(elements[i]);
    return left;
}

}  // namespace plumb
