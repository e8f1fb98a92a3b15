// SPDX-License-Identifier: MIT
#include "math/fnv1a.h"

#include <gtest/gtest.h>

#include <string_view>

namespace plumb::test {
namespace {

std::uint64_t hash_of(std::string_view text) {
    Fnv1a hash;
    hash.add(text.data(), text.size());
    return hash.value();
}

/// From the authors' table of test vectors.
TEST(Fnv1a, HasItsKnownValues) {
    EXPECT_EQ(hash_of(""), 0xcbf29ce484222325ull);
    EXPECT_EQ(hash_of("a"), 0xaf63dc4c8601ec8cull);
    EXPECT_EQ(hash_of("foobar"), 0x85944171f73967e8ull);
}

TEST(Fnv1a, TakesBytesInAnyPortions) {
    Fnv1a hash;
    hash.add("foo", 3);
    hash.add("bar", 3);
    EXPECT_EQ(hash.value(), hash_of("foobar"));
}

}  // namespace
}  // namespace plumb::test
