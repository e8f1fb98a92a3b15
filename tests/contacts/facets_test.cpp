// SPDX-License-Identifier: MIT
/// What is told of triangles at a glance errs on the safe side, wherever they are.
#include "contacts/facets.h"

#include "geometry/triangle.h"
#include "math/random.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plumb {
namespace {

TEST(Facets, NeitherMissWhatIsNearNorWhatIsFaced) {
    Random random(7);
    const auto within = [&](double size) {
        return Vector3d(random.between(-size, size), random.between(-size, size),
                        random.between(-size, size));
    };
    int faced = 0, passed_over = 0;
    for (const double far : {0.0, 10.0, 1e4}) {
        for (int i = 0; i < 4000; ++i) {
            const Vector3d middle = within(far);
            const Vector3d a = middle + within(0.1), b = middle + within(0.1),
                           c = middle + within(0.1), point = middle + within(0.3);
            const Vector3d normal = (b - a).cross(c - a).normalized();
            Facets facets;
            facets.resize(8);
            const auto place = static_cast<std::uint32_t>(i % 8);
            const Vector3d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
            facets.set(place, low, high, a, normal);
            const Facets::Sight sight = facets.look(0, point);

            const auto w = nearest_weights(point, a, b, c);
            const Vector3d apart = point - (w[0] * a + w[1] * b + w[2] * c);
            EXPECT_LE(sight.square[place], apart.squaredNorm());
            const double to_box = (low - point).cwiseMax(point - high).cwiseMax(0.0).norm();
            EXPECT_GE(std::sqrt(sight.square[place]), 0.99 * to_box - 1e-4 * (1 + far));
            const bool may_face = (sight.may_face >> place & 1) != 0;
            if (std::abs(apart.dot(normal)) >= Facets::kFacing * apart.norm()) {
                ++faced;
                EXPECT_TRUE(may_face);
            }
            passed_over += may_face ? 0 : 1;
        }
    }
    EXPECT_GT(faced, 100);
    EXPECT_GT(passed_over, 1000);
}

}  // namespace
}  // namespace plumb
