// SPDX-License-Identifier: MIT
#include "math/anderson.h"

#include "support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace plumb::test {
namespace {

using Rows = Anderson::Rows;

double product(const Rows& x, const Rows& y) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += x[i].dot(y[i]);
    return sum;
}

/// z ← z + B (b − A z) towards a known end, by rows whose error B A leaves to shares of its own.
struct Linear {
    Rows end, share;

    Linear(Random& random, std::size_t rows, double slowest) {
        for (std::size_t i = 0; i < rows; ++i) {
            end.push_back(random.vector());
            share.push_back(Eigen::Vector3d(random.number(0, slowest), random.number(0, slowest),
                                            random.number(0, slowest)));
        }
        share[0][0] = slowest;
    }
    Rows residual(const Rows& z) const {
        Rows d(z.size());
        for (std::size_t i = 0; i < z.size(); ++i)
            d[i] = (Eigen::Vector3d::Ones() - share[i]).cwiseProduct(end[i] - z[i]);
        return d;
    }
};

/// Steps until what is left to do is a millionth of the first step.
int steps_to_the_end(const Linear& problem, bool accelerated) {
    Rows z(problem.end.size(), Eigen::Vector3d::Zero()), step = z;
    Anderson earlier;
    earlier.clear(z.size());
    Rows d = problem.residual(z);
    const double first = std::sqrt(product(d, d));
    for (int i = 0; i < 2000; ++i) {
        if (std::sqrt(product(d, d)) < 1e-6 * first) return i;
        earlier.find(d, step, product);
        for (std::size_t k = 0; k < z.size(); ++k) z[k] += step[k];
        Rows next = problem.residual(z);
        if (accelerated) earlier.add(step, d, next, product);
        d = std::move(next);
    }
    return 2000;
}

TEST(Anderson, EndsInAboutTheRootOfTheSteps) {
    Random random(3);
    for (const double slowest : {0.8, 0.95, 0.99}) {
        const Linear problem(random, 20, slowest);
        const int plain = steps_to_the_end(problem, false), fast = steps_to_the_end(problem, true);
        EXPECT_LT(fast, 3 * std::sqrt(plain) + 5) << plain << " steps without";
    }
}

/// With fewer kinds of errors than it remembers steps, it takes one step for each.
TEST(Anderson, TakesAsManyStepsAsThereAreRates) {
    Random random(4);
    Linear problem(random, 30, 0.9);
    const double rates[] = {0.9, 0.5, 0.2};
    for (std::size_t i = 0; i < problem.share.size(); ++i)
        problem.share[i].setConstant(rates[i % 3]);
    EXPECT_LE(steps_to_the_end(problem, true), 4);
    EXPECT_GT(steps_to_the_end(problem, false), 50);
}

/// Steps that tell nothing new do no harm.
TEST(Anderson, BearsEqualSteps) {
    Anderson earlier;
    earlier.clear(1);
    const Rows step{Eigen::Vector3d(1, 0, 0)}, before{Eigen::Vector3d(2, 0, 0)},
        after{Eigen::Vector3d(1, 0, 0)};
    for (int i = 0; i < 3; ++i) earlier.add(step, before, after, product);
    Rows found(1);
    earlier.find(after, found, product);
    EXPECT_TRUE(found[0].allFinite());
    EXPECT_NEAR(found[0].x(), 1, 1e-6);  // where d = 0: the last step changed d by −1
}

}  // namespace
}  // namespace plumb::test
