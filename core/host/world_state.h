// SPDX-License-Identifier: MIT
/// What a step leaves for the next, number by number, and what it takes for granted.
///
/// Whoever adds a column that outlives a step adds it to `each_number` and raises kStateVersion.
#pragma once

#include "math/bytes.h"
#include "scene/geometry.h"
#include "world/world.h"

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace plumb {

inline constexpr std::uint32_t kStateVersion = 19;

/// Appends all that it is called with to a string of bytes.
class StateWriter {
public:
    explicit StateWriter(std::string& bytes) : bytes_(bytes) {}

    template <class T>
    requires std::is_arithmetic_v<T>
    void operator()(const T& x) { put(bytes_, x); }

    template <class T>
    void count(const std::vector<T>& list) {
        put(bytes_, static_cast<std::uint64_t>(list.size()));
    }

private:
    std::string& bytes_;
};

/// Takes what a StateWriter wrote, in the same order. Throws std::out_of_range when the bytes end
/// too early.
class StateReader {
public:
    explicit StateReader(std::string_view bytes) : bytes_(bytes) {}

    template <class T>
    requires std::is_arithmetic_v<T>
    void operator()(T& x) {
        if constexpr (std::is_same_v<T, bool>)
            x = bytes_.take<std::uint8_t>() != 0;
        else
            x = bytes_.take<T>();
    }

    /// Makes a list as long as the one that was written.
    template <class T>
    void count(std::vector<T>& list) {
        const auto length = bytes_.take<std::uint64_t>();
        if (length > bytes_.left()) throw std::out_of_range("the bytes end too early");
        list.resize(static_cast<std::size_t>(length));
    }

private:
    ByteReader bytes_;
};

/// The length of a list and its numbers.
template <class Io, class List>
void each_number_of_list(Io& io, List& list) {
    io.count(list);
    for (auto& x : list) io(x);
}

/// What of a world outlives a step, besides World::excluded: into bytes, or back into a world of
/// the same `foundation`.
void write_state(const World& world, StateWriter& to);
void read_state(World& world, StateReader& from);

/// A hash of what a scene and edits have made of a world and no step changes: who is there, of what
/// shape, mass and material, what joints and links hold it, and the settings without threads and
/// lanes.
std::uint64_t foundation(const World& world, const std::vector<Geometry>& geometries);

}  // namespace plumb
