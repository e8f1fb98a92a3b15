// SPDX-License-Identifier: MIT
/// Jacobi's elliptic functions, which the exact motions of pendulums and free tops are made of.
#pragma once

#include <array>
#include <cmath>

namespace plumb::study {

struct Elliptic {
    double sn, cn, dn;
};

/// sn, cn, dn of argument u and modulus k in [0, 1), by descending Landen transformation
/// (Abramowitz, Stegun: Handbook of Mathematical Functions, 16.4).
inline Elliptic jacobi(double u, double k) {
    constexpr int kMost = 16;
    std::array<double, kMost + 1> a{1}, c{k};
    double b = std::sqrt(1 - k * k);
    int n = 0;
    while (std::abs(c[n]) > 1e-17 && n < kMost) {
        a[n + 1] = 0.5 * (a[n] + b);
        c[n + 1] = 0.5 * (a[n] - b);
        b = std::sqrt(a[n] * b);
        ++n;
    }
    double phi = std::ldexp(a[n] * u, n);
    for (int i = n; i > 0; --i) phi = 0.5 * (phi + std::asin(c[i] / a[i] * std::sin(phi)));
    const double cn = std::cos(phi);
    return {std::sin(phi), cn, std::sqrt((1 - k) * (1 + k) + k * k * cn * cn)};
}

}  // namespace plumb::study
