// SPDX-License-Identifier: MIT
/// Every operator of lanes gives, in each lane, the bits of the same operator on one number.
#include "math/lanes.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace plumb {
namespace {

template <class Real, int N>
struct Width {
    using Number = Real;
    static constexpr int kLanes = N;
};

template <class T>
class Lanes_ : public testing::Test {
protected:
    using Real = typename T::Number;
    static constexpr int kLanes = T::kLanes;
    using Lane = Lanes<Real, kLanes>;
    struct alignas(64) Values {
        Real at[kLanes];
    };

    Lanes_() {
        using Limits = std::numeric_limits<Real>;
        special_ = {Real(0),
                    -Real(0),
                    Real(1),
                    Real(-1),
                    Limits::max(),
                    Limits::lowest(),
                    Limits::min(),
                    Limits::denorm_min(),
                    Limits::infinity(),
                    -Limits::infinity(),
                    Limits::quiet_NaN()};
    }

    /// Ordinary numbers of many sizes, and now and then one at an edge of the format.
    Values draw() {
        Values v;
        for (Real& x : v.at) {
            const double size = std::exp2(static_cast<double>(random_() % 40) - 20);
            x = random_() % 4 == 0 ? special_[random_() % special_.size()]
                                   : static_cast<Real>(size * number_(random_));
        }
        return v;
    }

    static bool same_bits(Real x, Real y) {
        using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
        return (std::isnan(x) && std::isnan(y)) || std::bit_cast<Bits>(x) == std::bit_cast<Bits>(y);
    }

    template <class OnLanes, class OnNumber>
    void expect_same(const char* what, OnLanes on_lanes, OnNumber on_number) {
        for (int round = 0; round < 500; ++round) {
            const Values a = draw(), b = draw(), c = draw(), d = draw();
            Values result;
            Lane(on_lanes(Lane::load(a.at), Lane::load(b.at), Lane::load(c.at), Lane::load(d.at)))
                .store(result.at);
            for (int i = 0; i < kLanes; ++i) {
                const Real expected = on_number(a.at[i], b.at[i], c.at[i], d.at[i]);
                ASSERT_TRUE(same_bits(result.at[i], expected))
                    << what << " of " << a.at[i] << ", " << b.at[i] << ": " << result.at[i]
                    << " in lane " << i << ", " << expected << " alone";
            }
        }
    }

    std::mt19937 random_{17};
    std::uniform_real_distribution<double> number_{-1, 1};
    std::vector<Real> special_;
};

using Widths = testing::Types<Width<float, 4>, Width<float, 8>, Width<float, 16>, Width<double, 4>,
                              Width<double, 8>, Width<double, 16>>;
TYPED_TEST_SUITE(Lanes_, Widths);

#define PLUMB_SAME(what, formula)                                                     \
    this->expect_same(                                                                \
        what,                                                                         \
        []([[maybe_unused]] auto a, [[maybe_unused]] auto b, [[maybe_unused]] auto c, \
           [[maybe_unused]] auto d) { return formula; },                              \
        []([[maybe_unused]] auto a, [[maybe_unused]] auto b, [[maybe_unused]] auto c, \
           [[maybe_unused]] auto d) { return formula; })

TYPED_TEST(Lanes_, ArithmeticIsThatOfOneNumber) {
    PLUMB_SAME("sum", a + b);
    PLUMB_SAME("difference", a - b);
    PLUMB_SAME("product", a * b);
    PLUMB_SAME("quotient", a / b);
    PLUMB_SAME("negative", -a);
    PLUMB_SAME("square root", sqrt(a));
}

TYPED_TEST(Lanes_, ChoicesAreThoseOfOneNumber) {
    PLUMB_SAME("least", min(a, b));
    PLUMB_SAME("greatest", max(a, b));
    PLUMB_SAME("choice", select_greater(a, b, c, d));
}

/// No multiply and add are fused, in lanes or alone.
TYPED_TEST(Lanes_, SumsOfProductsAreRoundedTwice) {
    PLUMB_SAME("sum of products", a * b + c * d);
    PLUMB_SAME("difference of products", a * b - c * d);
}

TYPED_TEST(Lanes_, AssignmentsDoWhatTheOperatorsDo) {
    PLUMB_SAME("+=", (a += b, a));
    PLUMB_SAME("-=", (a -= b, a));
    PLUMB_SAME("*=", (a *= b, a));
    PLUMB_SAME("/=", (a /= b, a));
}

TYPED_TEST(Lanes_, AScalarStandsForEqualLanes) {
    using L = typename TestFixture::Lane;
    typename TestFixture::Values out;
    for (auto x : this->special_) {
        L(x).store(out.at);
        for (auto y : out.at) EXPECT_TRUE(this->same_bits(y, x)) << y << " instead of " << x;
    }
}

TYPED_TEST(Lanes_, VectorsLoadAndStoreByComponent) {
    using R = typename TestFixture::Real;
    constexpr int n = TestFixture::kLanes;
    alignas(64) R from[3][n];
    alignas(64) R to[3][n] = {};
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < n; ++i) from[c][i] = static_cast<R>(100 * c + i);
    store_vector(to, Vector3<Number<R, n>>(load_vector(from)));
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < n; ++i) EXPECT_EQ(to[c][i], from[c][i]);
}

}  // namespace
}  // namespace plumb
