// SPDX-License-Identifier: MIT
/// Eliminations whose pivots rounding has eaten.
#include "math/dense.h"
#include "math/symmetric.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb {
namespace {

using test::Random;

template <class T>
class Pivots : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Pivots, Reals);

TYPED_TEST(Pivots, AreLeftAloneWhereTheyMeanAnything) {
    using T = TypeParam;
    const T least = kLeastPivot<T>;
    for (const T entry : {T(1e-20), T(1), T(3e15)}) {
        for (const T share : {T(1), T(0.3), 10 * least, least})
            EXPECT_EQ(held_pivot<T>(share * entry, entry), share * entry);
        for (const T share : {least / 2, T(0), -least, T(-1)})
            EXPECT_EQ(held_pivot<T>(share * entry, entry), least * entry);
    }
}

/// K = 1 + s v vᵀ for an s that leaves nothing of the 1, as of a body held far outside of it.
template <class T, int N>
void fill(T (&k)[N][N], T (&c)[N], T s, Random& random) {
    T v[N];
    for (int i = 0; i < N; ++i) v[i] = T(random.number(-1, 1)), c[i] = T(random.number(-1, 1));
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) k[i][j] = s * v[i] * v[j] + T(i == j);
}

/// No entry of K⁻¹ is above 1, and none that comes out is above what the least pivot makes of it.
TYPED_TEST(Pivots, OfSingularSystemsGiveFiniteAnswers) {
    using T = TypeParam;
    Random random(5);
    for (int round = 0; round < 200; ++round) {
        const T s = T(std::pow(10.0, random.number(2, 30)));
        T k[6][6], c[6], factors[6][6], x[6];
        fill(k, c, s, random);
        for (int i = 0; i < 6; ++i) {
            x[i] = c[i];
            for (int j = 0; j < 6; ++j) factors[i][j] = k[i][j];
        }
        const Symmetric3<T> three{k[0][0], k[1][1], k[2][2], k[1][0], k[2][0], k[2][1]};
        const Vector3<T> of_three = solve_ldlt<T>(three, Vector3<T>(c[0], c[1], c[2]));
        solve_ldlt<T, 6>(k, c);
        factor_ldlt(factors, 6);
        solve_factored(factors, 6, x);
        for (int i = 0; i < 6; ++i) {
            EXPECT_TRUE(std::isfinite(c[i])) << s;
            EXPECT_TRUE(std::isfinite(x[i])) << s;
            EXPECT_TRUE(std::isfinite(of_three[i % 3])) << s;
        }
    }
}

/// The same bits in each lane as alone, whatever its neighbours are.
TEST(PivotLanes, AreTheSameAsAlone) {
    using Four = Lanes<float, 4>;
    Random random(6);
    for (int round = 0; round < 100; ++round) {
        float k[4][6][6], c[4][6];
        alignas(16) float side[4];
        for (int lane = 0; lane < 4; ++lane)
            fill(k[lane], c[lane], lane % 2 ? 1e12f : 1.0f, random);
        Four many[6][6], right[6];
        for (int i = 0; i < 6; ++i) {
            for (int lane = 0; lane < 4; ++lane) side[lane] = c[lane][i];
            right[i] = load<float, 4>(side);
            for (int j = 0; j < 6; ++j) {
                for (int lane = 0; lane < 4; ++lane) side[lane] = k[lane][i][j];
                many[i][j] = load<float, 4>(side);
            }
        }
        solve_ldlt<Four, 6>(many, right);
        for (int lane = 0; lane < 4; ++lane) {
            solve_ldlt<float, 6>(k[lane], c[lane]);
            for (int i = 0; i < 6; ++i) {
                right[i].store(side);
                EXPECT_EQ(side[lane], c[lane][i]);
            }
        }
    }
}

}  // namespace
}  // namespace plumb
