// SPDX-License-Identifier: MIT
/// Principal moments and axes of a tensor of inertia.
#pragma once

#include "math/types.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace plumb {

struct Principal {
    Vector3d moments;
    Quaterniond axes;  ///< principal axes → the tensor's
};

/// Of a symmetric tensor; axes are left alone where it is diagonal already.
inline Principal principal_axes(const Matrix3d& tensor) {
    const Vector3d diagonal = tensor.diagonal();
    const double off = std::abs(tensor(0, 1)) + std::abs(tensor(0, 2)) + std::abs(tensor(1, 2));
    if (off <= 1e-12 * diagonal.sum()) return {diagonal, Quaterniond::Identity()};
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(tensor);
    Matrix3d axes = solver.eigenvectors();
    if (axes.determinant() < 0) axes.col(2) *= -1;
    return {solver.eigenvalues(), Quaterniond(axes).normalized()};
}

}  // namespace plumb
