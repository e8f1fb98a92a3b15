// SPDX-License-Identifier: MIT
/// Boxes in a tree are found by other boxes: all that meet, each once, wherever they have gone.
#include "schedule/box_tree.h"

#include "math/random.h"

#include <gtest/gtest.h>

namespace plumb {
namespace {

class BoxesInATree : public testing::TestWithParam<std::uint32_t> {
protected:
    Vector3d place(double size) {
        return {random_.between(-size, size), random_.between(-size, size),
                random_.between(-size, size)};
    }
    /// Boxes about places in a cube of this half side.
    void scatter(double size) {
        low_.clear(), high_.clear();
        for (std::uint32_t i = 0; i < GetParam(); ++i) {
            const Vector3d middle = place(size), extent = place(0.3).cwiseAbs();
            low_.push_back(middle - extent), high_.push_back(middle + extent);
        }
    }
    /// All that meet, each once, and none that is apart by more than single precision tells.
    void expect_found(const Vector3d& low, const Vector3d& high) const {
        std::vector<int> found(GetParam(), 0);
        tree_.each_near(low, high, [&](std::uint32_t box) { ++found.at(box); });
        for (std::uint32_t i = 0; i < GetParam(); ++i) {
            EXPECT_LE(found[i], 1);
            const Vector3d apart = (low - high_[i]).cwiseMax(low_[i] - high);
            if (apart.maxCoeff() <= 0) {
                EXPECT_EQ(found[i], 1) << i;
            }
            const double size = low_[i].cwiseAbs().cwiseMax(high_[i].cwiseAbs()).maxCoeff() +
                                low.cwiseAbs().cwiseMin(high.cwiseAbs()).maxCoeff();
            if (apart.maxCoeff() > 1e-6 * size) {
                EXPECT_EQ(found[i], 0) << i;
            }
        }
    }

    Random random_{5};
    std::vector<Vector3d> low_, high_;
    BoxTree tree_;
};
INSTANTIATE_TEST_SUITE_P(, BoxesInATree, testing::Values(0u, 1u, 8u, 9u, 64u, 65u, 1000u));

TEST_P(BoxesInATree, AreFound) {
    scatter(1);
    std::vector<std::uint32_t> groups;
    for (std::uint32_t i = 0; i < GetParam(); ++i) groups.push_back(i / 40);
    tree_.build(low_, groups);
    for (const double size : {1.0, 1e-3, 1e5}) {
        scatter(size);
        for (std::uint32_t i = 0; i < tree_.size(); ++i)
            tree_.set(i, low_[tree_.box_at(i)], high_[tree_.box_at(i)]);
        tree_.close();
        for (int i = 0; i < 20; ++i) {
            const Vector3d middle = place(size), extent = place(0.3 * size).cwiseAbs();
            expect_found(middle - extent, middle + extent);
        }
        if (!low_.empty()) expect_found(high_[0], high_[0]);
        expect_found(Vector3d::Constant(-1e300), Vector3d::Constant(1e300));
    }
}

TEST(ABoxInATree, IsNotFoundFromAfar) {
    BoxTree tree;
    tree.build({Vector3d::Zero()}, {0});
    tree.set(0, Vector3d::Constant(-1), Vector3d::Constant(1));
    tree.close();
    int found = 0;
    tree.each_near({1.1, 0, 0}, {2, 0, 0}, [&](std::uint32_t) { ++found; });
    EXPECT_EQ(found, 0);
}

}  // namespace
}  // namespace plumb
