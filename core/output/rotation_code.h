// SPDX-License-Identifier: MIT
/// Rotations as three integers and the index of the one component that is left out ("smallest
/// three").
///
/// A unit quaternion's largest component follows from the other three, which lie within ±1/√2. q
/// and −q are the same rotation, so the largest is taken as positive. With `bits` bits a component,
/// each of the three is off by at most half a quantum, √2 / (2^bits − 1) / 2.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>

namespace plumb {

/// A rotation as integers. `largest`: index into (x, y, z, w) of the component left out.
struct RotationCode {
    std::array<std::uint32_t, 3> small{};
    std::uint32_t largest = 3;
};

/// Distance of two neighbouring values of a component.
inline double rotation_quantum(int bits) {
    return std::sqrt(2.0) / static_cast<double>((1u << bits) - 1);
}

/// Greatest angle [rad] between a rotation and its decoded code.
///
/// Three components err by q/2 each; the fourth, which is at least 1/2, follows with at most
/// (√3 q/2)·(√3/2)/(1/2) = 3q/2. An error of length e between unit quaternions is an angle of at
/// most 2·2·asin(e/2).
inline double rotation_error_bound(int bits) {
    const double q = rotation_quantum(bits);
    const double length = q * std::sqrt(0.75 + 2.25);
    return 4 * std::asin(length / 2) * 1.01;  // 1 % for the second order
}

/// A quaternion that is not finite, or zero, is coded as the identity.
inline RotationCode encode_rotation(const Eigen::Quaterniond& rotation, int bits) {
    Eigen::Vector4d q = rotation.coeffs();
    const double length = q.norm();
    q = std::isfinite(length) && length > 0 ? Eigen::Vector4d(q / length)
                                            : Eigen::Vector4d(0, 0, 0, 1);
    Eigen::Index largest = 0;
    q.cwiseAbs().maxCoeff(&largest);
    if (q[largest] < 0) q = -q;

    RotationCode code;
    code.largest = static_cast<std::uint32_t>(largest);
    const double most = static_cast<double>((1u << bits) - 1);
    for (Eigen::Index i = 0, k = 0; i < 4; ++i) {
        if (i == largest) continue;
        const double step = std::round((q[i] + std::sqrt(0.5)) / rotation_quantum(bits));
        code.small[static_cast<std::size_t>(k++)] =
            static_cast<std::uint32_t>(std::min(std::max(step, 0.0), most));
    }
    return code;
}

inline Eigen::Quaterniond decode_rotation(const RotationCode& code, int bits) {
    Eigen::Vector4d q = Eigen::Vector4d::Zero();
    const auto largest = static_cast<Eigen::Index>(code.largest & 3u);
    for (Eigen::Index i = 0, k = 0; i < 4; ++i) {
        if (i == largest) continue;
        q[i] = code.small[static_cast<std::size_t>(k++)] * rotation_quantum(bits) - std::sqrt(0.5);
    }
    q[largest] = std::sqrt(std::max(0.0, 1 - q.squaredNorm()));
    return Eigen::Quaterniond(q).normalized();
}

}  // namespace plumb
