// SPDX-License-Identifier: MIT
/// How long a pendulum takes for a swing: by theory, and as seen.
#pragma once

#include <cmath>

namespace plumb::test {

/// T/T₀ of a pendulum with the given amplitude [rad] against that of a small one: the
/// arithmetic-geometric mean of 1 and cos(θ/2).
inline double lengthening(double amplitude) {
    double a = 1, g = std::cos(0.5 * amplitude);
    for (int i = 0; i < 20; ++i) {
        const double mean = 0.5 * (a + g);
        g = std::sqrt(a * g), a = mean;
    }
    return 1 / a;
}

/// Period by the passages of a body through x = 0 [s].
class PeriodWatch {
public:
    void see(double time, double dt, double x) {
        if (seen_ && (x > 0) != (before_ > 0)) {
            latest_ = time - dt * x / (x - before_);
            if (++passages_ == 1) first_ = latest_;
        }
        seen_ = true, before_ = x;
    }
    double period() const { return 2 * (latest_ - first_) / (passages_ - 1); }

private:
    bool seen_ = false;
    double before_ = 0, first_ = 0, latest_ = 0;
    int passages_ = 0;
};

}  // namespace plumb::test
