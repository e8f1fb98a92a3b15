// SPDX-License-Identifier: MIT
/// The 64-bit FNV-1a hash (Fowler, Noll, Vo).
#pragma once

#include <cstddef>
#include <cstdint>

namespace plumb {

class Fnv1a {
public:
    void add(const void* bytes, std::size_t count) {
        const auto* byte = static_cast<const unsigned char*>(bytes);
        for (std::size_t i = 0; i < count; ++i) value_ = (value_ ^ byte[i]) * 1099511628211ull;
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 14695981039346656037ull;
};

}  // namespace plumb
