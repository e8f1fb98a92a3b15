// SPDX-License-Identifier: MIT
/// Points that a mesh's file calls by numbers of its own.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "reader/meshes/mesh_text.h"

namespace plumb::reader {

class NumberedPoints {
public:
    void add(std::uint64_t number, const Eigen::Vector3d& point, const MeshText& text) {
        if (!points_.emplace(number, point).second)
            text.fail("point " + std::to_string(number) + " is there twice");
    }

    /// Adds an element to a list of them, by the numbers of its points, which it checks.
    template <std::size_t N>
    void add_element(std::vector<std::array<std::uint64_t, N>>& to,
                     const std::array<std::uint64_t, N>& element, const MeshText& text) const {
        for (const std::uint64_t number : element)
            if (!points_.contains(number)) text.fail("there is no point " + std::to_string(number));
        to.push_back(element);
    }

    /// Elements by indices of `points`, to which the points that they use are added.
    template <std::size_t N>
    std::vector<std::array<std::uint32_t, N>> taken(
        const std::vector<std::array<std::uint64_t, N>>& elements,
        std::vector<Eigen::Vector3d>& points) const {
        std::unordered_map<std::uint64_t, std::uint32_t> index;
        std::vector<std::array<std::uint32_t, N>> made(elements.size());
        for (std::size_t i = 0; i < elements.size(); ++i)
            for (std::size_t k = 0; k < N; ++k) {
                const auto next = static_cast<std::uint32_t>(points.size());
                const auto [place, is_new] = index.emplace(elements[i][k], next);
                if (is_new) points.push_back(points_.at(elements[i][k]));
                made[i][k] = place->second;
            }
        return made;
    }

private:
    std::unordered_map<std::uint64_t, Eigen::Vector3d> points_;
};

}  // namespace plumb::reader
