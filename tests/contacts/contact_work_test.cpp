// SPDX-License-Identifier: MIT
/// How much of an island's impulses may be taken.
#include "contacts/contact_work.h"

#include <gtest/gtest.h>

namespace plumb::test {
namespace {

TEST(ContactWork, IsTakenWholeWhereItLosesEnergy) {
    ContactWork work;
    work.at_start = -3, work.of_change = 1;
    EXPECT_EQ(work.share(0), 1);
}

/// A share s of the impulses adds s at_start + s² of_change.
TEST(ContactWork, TakesTheShareThatAddsWhatIsGranted) {
    ContactWork work;
    work.at_start = 0.5, work.of_change = 4, work.granted = 2;
    const double s = work.share(1e9);
    EXPECT_NEAR(s * work.at_start + s * s * work.of_change, s * work.granted, 1e-12);
    const double least = work.share(0.1);
    EXPECT_LT(least, s);
    EXPECT_NEAR(least * work.at_start + least * least * work.of_change, 0.1, 1e-12);
}

TEST(ContactWork, GrantsTheWayToTheSpeedThatIsAskedFor) {
    EXPECT_EQ(granted_speed(-3, 1), 0) << "it loses energy on that way";
    EXPECT_EQ(granted_speed(0, 1), 0.5);
    EXPECT_EQ(granted_speed(2, 1), 1) << "it is faster already";
}

TEST(ContactWork, ASpeedStaysWithinItsBound) {
    const Vector3d before(1, -2, 0.5), change(8, 3, -1);
    const double s = share_within(4, before, change);
    EXPECT_NEAR((before + s * change).norm(), 4, 1e-12);
    EXPECT_EQ(share_within(20, before, change), 1);
    // rounding must not turn a change about that hardly is one
    const double bound = (1 + 1e-6) * before.norm();
    for (const double tiny : {1e-9, 1e-12, 1e-15}) {
        const double share = share_within(bound, before, tiny * before);
        EXPECT_TRUE(share >= 0 && share <= 1) << tiny;
    }
}

}  // namespace
}  // namespace plumb::test
