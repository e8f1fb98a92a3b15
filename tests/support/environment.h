// SPDX-License-Identifier: MIT
/// Sizes of tests that a longer run may set.
#pragma once

#include <cstdlib>

namespace plumb::test {

inline int number_from(const char* variable, int otherwise) {
    const char* const value = std::getenv(variable);
    return value ? std::atoi(value) : otherwise;
}

}  // namespace plumb::test
