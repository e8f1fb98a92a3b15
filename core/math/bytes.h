// SPDX-License-Identifier: MIT
/// Numbers as little-endian bytes, the same on every machine.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace plumb {

/// The unsigned integer that has as many bytes as T.
template <class T>
using BitsOf = std::conditional_t<
    sizeof(T) == 1, std::uint8_t,
    std::conditional_t<sizeof(T) == 2, std::uint16_t,
                       std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;

/// Appends a number to a string of bytes.
template <class T>
requires std::is_arithmetic_v<T>
void put(std::string& bytes, T value) {
    const auto bits = std::bit_cast<BitsOf<T>>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        bytes.push_back(static_cast<char>((bits >> (8 * i)) & 0xffu));
    }
}

/// Takes numbers off the front of a string of bytes; throws std::out_of_range when it ends too
/// early.
class ByteReader {
public:
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

    template <class T>
    requires std::is_arithmetic_v<T> T take() {
        const std::string_view part = take_bytes(sizeof(T));
        BitsOf<T> bits = 0;
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            bits = static_cast<BitsOf<T>>(
                bits | (static_cast<BitsOf<T>>(static_cast<unsigned char>(part[i])) << (8 * i)));
        }
        return std::bit_cast<T>(bits);
    }

    std::string_view take_bytes(std::size_t count) {
        if (count > left()) throw std::out_of_range("the bytes end too early");
        const std::string_view part = bytes_.substr(position_, count);
        position_ += count;
        return part;
    }

    std::size_t position() const { return position_; }
    std::size_t left() const { return bytes_.size() - position_; }

private:
    std::string_view bytes_;
    std::size_t position_ = 0;
};

}  // namespace plumb
