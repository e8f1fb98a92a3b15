// SPDX-License-Identifier: MIT
/// What is left of a deformable's elements.
#pragma once

#include <cstdint>
#include <vector>

namespace plumb {

/// Calls visit(element, index) for each whose index is not in `gone`, which is sorted.
template <class Element, class Visit>
void each_left(const std::vector<Element>& elements, const std::vector<std::uint32_t>& gone,
               Visit visit) {
    auto next = gone.begin();
    for (std::uint32_t i = 0; i < elements.size(); ++i) {
        if (next != gone.end() && *next == i)
            ++next;
        else
            visit(elements[i], i);
    }
}

/// These elements.
template <class Element>
std::vector<Element> elements_left(const std::vector<Element>& elements,
                                   const std::vector<std::uint32_t>& gone) {
    std::vector<Element> left;
    each_left(elements, gone, [&](const Element& e, std::uint32_t) { left.push_back(e); });
    return left;
}

}  // namespace plumb
