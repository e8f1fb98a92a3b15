// SPDX-License-Identifier: MIT
#include "constraints/air_drag.h"

#include "support/random.h"

#include <gtest/gtest.h>

namespace plumb::test {
namespace {

/// ½ ρ A (c wₙ² n + 2 c_f w_t² t) of a sheet, and half of it on a closed surface.
TEST(AirDrag, IsThatOfAPlateAcrossAndAlongTheWind) {
    const double density = 1.3, drag = 1.1, skin_drag = 0.02;
    const Vector3d n(0, 0, 1), w(3, 0, 4);
    for (const bool is_closed : {false, true}) {
        const AirCoefficients c = air_coefficients(density, drag, skin_drag, is_closed);
        const Vector3d force = air_resistance(c, 0.5 * n, w) * w;
        const double share = is_closed ? 0.5 : 1;
        EXPECT_NEAR(force.z(), share * 0.5 * density * 0.5 * drag * 16, 1e-12);
        EXPECT_NEAR(force.x(), share * 0.5 * density * 0.5 * 2 * skin_drag * 9, 1e-12);
        EXPECT_NEAR(force.y(), 0, 1e-12);
        EXPECT_EQ(air_resistance(c, -0.5 * n, w), air_resistance(c, 0.5 * n, w));
    }
    EXPECT_EQ(air_resistance({1, 1}, Vector3d::Zero(), w), Matrix3d::Zero()) << "no area";
}

/// w' = w − h k w'² / m where only a normal counts, whatever h is.
TEST(AirDrag, AlongANormalIsImplicitEuler) {
    const Vector3d w(0, 5, 0);
    for (const double h : {1e-6, 1e-3, 1.0, 1e6}) {
        const Matrix3d resistance = air_resistance({0.7, 0}, {0, 2, 0}, w);
        const Vector3d after = dragged(w, resistance, 0.3, h);
        EXPECT_NEAR(w.y() - after.y(), h * 0.7 * 2 * after.y() * after.y() / 0.3, 1e-9 * w.y());
        EXPECT_GT(after.y(), 0);
    }
}

/// Triangles of any size about a point of any mass, any wind and any time.
TEST(AirDrag, NeverTurnsBackOrSpeedsUp) {
    Random random(3);
    for (int draw = 0; draw < 2000; ++draw) {
        const auto power = [&] { return std::pow(10, random.number(-6, 6)); };
        const Vector3d w = power() * random.vector();
        Matrix3d resistance = Matrix3d::Zero();
        for (int i = 0; i < 6; ++i)
            resistance += air_resistance({power(), power()}, power() * random.vector(), w);
        const Vector3d after = dragged(w, resistance, power(), power());
        EXPECT_LE(after.norm(), w.norm() * (1 + 1e-12));
        EXPECT_GE(after.dot(w), 0);
    }
    EXPECT_EQ(dragged(Vector3d::Zero(), Matrix3d::Zero(), 1, 1), Vector3d::Zero());
}

}  // namespace
}  // namespace plumb::test
