// SPDX-License-Identifier: MIT
/// The types of single values. Each can read a Node, and can say the same to a JSON Schema.
///
/// A type has `read(node)`, which returns the value or throws, and `schema()`. Tables (table.h) put
/// a type behind each key.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reader/json/node.h"
#include "scene/nearest.h"

namespace plumb::reader {

using SchemaJson = nlohmann::ordered_json;  // keeps the order in which keys are written

/// What numbers are allowed, both ends included.
struct Range {
    double low, high;
};

inline constexpr Range kCoordinate{-1e9, 1e9};  ///< positions, velocities, forces in their units
inline constexpr Range kLength{1e-6, 1e6};      ///< sizes [m]
inline constexpr Range kNotNegative{0, 1e9};
inline constexpr Range kMass{1e-12, 1e15};  ///< [kg], and [kg m²], [kg/m³]
inline constexpr Range kAny{-1e300, 1e300};
inline constexpr double kMostExact = 9007199254740992.0;  ///< 2^53, up to which JSON keeps whole
                                                          ///< numbers

/// "0.25".
std::string short_number(double value);

/// "a number above 0, from 1e-06 to 1e+06".
std::string in_words(const Range& range, const std::string& noun);

/// Fails unless the node is a list of `count` values ("a list of 3 numbers").
void require_list(const Node& node, std::size_t count, const std::string& noun);

struct Number {
    Range range;
    double read(const Node& node) const;
    SchemaJson schema() const;
};

/// A whole number; `range` lies within ±2^53.
template <class T>
struct Whole {
    Range range;
    T read(const Node& node) const;
    SchemaJson schema() const;
};

/// [x, y, z].
struct Vector3 {
    Range range;
    Eigen::Vector3d read(const Node& node) const;
    SchemaJson schema() const;
};

struct Flag {
    bool read(const Node& node) const;
    SchemaJson schema() const;
};

/// [true, false, true].
struct Flags3 {
    std::array<bool, 3> read(const Node& node) const;
    SchemaJson schema() const;
};

/// A text that is not empty.
struct Text {
    std::string read(const Node& node) const;
    SchemaJson schema() const;
};

struct TextList {
    std::vector<std::string> read(const Node& node) const;
    SchemaJson schema() const;
};

/// One of a few words, each standing for a value of E.
template <class E>
struct Choice {
    std::vector<std::pair<std::string, E>> words;

    E read(const Node& node) const {
        const std::string word = Text{}.read(node);
        for (const auto& [name, value] : words) {
            if (name == word) return value;
        }
        node.fail("unknown value \"" + word + "\"" + advice(word, names()));
    }
    SchemaJson schema() const { return {{"enum", names()}}; }

private:
    std::vector<std::string> names() const {
        std::vector<std::string> list;
        for (const auto& entry : words) list.push_back(entry.first);
        return list;
    }
};

/// "#rrggbb" → 0xRRGGBB. Black becomes 0x000001, for 0 means "chosen by the viewer".
struct Color {
    std::uint32_t read(const Node& node) const;
    SchemaJson schema() const;
};

}  // namespace plumb::reader
