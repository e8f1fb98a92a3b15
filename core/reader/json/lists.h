// SPDX-License-Identifier: MIT
/// Types of values that are lists: of points, of numbers, of indices.
#pragma once

#include <array>
#include <cstddef>

#include "reader/json/types.h"

namespace plumb::reader {

inline SchemaJson list_schema(const SchemaJson& item, std::size_t count) {
    return {{"type", "array"}, {"items", item}, {"minItems", count}, {"maxItems", count}};
}

/// Fails unless the node is a list ("a list of points [x, y, z]").
inline void require_any_list(const Node& node, const std::string& noun) {
    if (!node.json().is_array()) node.fail_wanting("a list of " + noun);
}

/// [2, 4.5].
template <std::size_t N>
struct NumberList {
    Range range;

    std::array<double, N> read(const Node& node) const {
        require_list(node, N, "numbers");
        std::array<double, N> list;
        for (std::size_t i = 0; i < N; ++i) list[i] = Number{range}.read(node.at(i));
        return list;
    }
    SchemaJson schema() const { return list_schema(Number{range}.schema(), N); }
};

/// [2, 4].
template <std::size_t N>
struct WholeList {
    Range range;

    std::array<std::uint32_t, N> read(const Node& node) const {
        require_list(node, N, "whole numbers");
        const Whole<std::uint32_t> whole{range};
        std::array<std::uint32_t, N> list;
        for (std::size_t i = 0; i < N; ++i) list[i] = whole.read(node.at(i));
        return list;
    }
    SchemaJson schema() const { return list_schema(Whole<std::uint32_t>{range}.schema(), N); }
};

/// [[x, y, z], …].
struct PointList {
    static constexpr Range range{-1e6, 1e6};

    std::vector<Eigen::Vector3d> read(const Node& node) const {
        require_any_list(node, "points [x, y, z]");
        std::vector<Eigen::Vector3d> list;
        list.reserve(node.size());
        for (std::size_t i = 0; i < node.size(); ++i)
            list.push_back(Vector3{range}.read(node.at(i)));
        return list;
    }
    SchemaJson schema() const { return {{"type", "array"}, {"items", Vector3{range}.schema()}}; }
};

/// [[i, j, k], …].
template <std::size_t N>
struct IndexList {
    std::string noun;  ///< "triangles [i, j, k]"
    std::string of;    ///< "vertices"

    std::vector<std::array<std::uint32_t, N>> read(const Node& node) const {
        require_any_list(node, noun);
        const Whole<std::uint32_t> index{kIndex};
        std::vector<std::array<std::uint32_t, N>> list(node.size());
        for (std::size_t i = 0; i < node.size(); ++i) {
            const Node element = node.at(i);
            require_list(element, N, "indices of " + of);
            for (std::size_t k = 0; k < N; ++k) list[i][k] = index.read(element.at(k));
        }
        return list;
    }
    SchemaJson schema() const {
        return {{"type", "array"},
                {"items", list_schema(Whole<std::uint32_t>{kIndex}.schema(), N)}};
    }

private:
    static constexpr Range kIndex{0, 4294967294.0};
};

}  // namespace plumb::reader
