// SPDX-License-Identifier: MIT
#include "scene/nearest.h"

#include <gtest/gtest.h>

namespace plumb {

TEST(Nearest, CountsEdits) {
    EXPECT_EQ(edit_distance("friction", "friction"), 0u);
    EXPECT_EQ(edit_distance("frction", "friction"), 1u);
    EXPECT_EQ(edit_distance("firction", "friction"), 1u);  // a swap of two neighbours is one edit
    EXPECT_EQ(edit_distance("", "dt"), 2u);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(Nearest, FindsTheNearestOrNothing) {
    const std::vector<std::string> keys = {"density", "friction", "restitution"};
    EXPECT_EQ(nearest("restituton", keys), "restitution");
    EXPECT_EQ(nearest("colour", keys), "");
    EXPECT_EQ(nearest("", {"x", "turn_x"}), "");  // every short word is one letter away
    EXPECT_EQ(nearest(std::string(1000, 'f'), keys), "");
}

TEST(Nearest, ListsWhatIsAllowed) {
    EXPECT_EQ(advice("densty", {"density", "mass"}),
              "; did you mean \"density\"? Allowed: density, mass");
    EXPECT_EQ(advice("xyz", {"density"}), ". Allowed: density");
    EXPECT_EQ(advice("xyz", {}), ".");
}

}  // namespace plumb
