// SPDX-License-Identifier: MIT
/// How far an element is stretched where it is stretched most.
///
///   D, D₀  edges from its first point, now and at rest; G = DᵀD, G₀ = D₀ᵀD₀
///
/// The squares of the principal stretches are the eigenvalues of G against G₀, of a segment, a
/// triangle and a tetrahedron alike.
#pragma once

#include "math/types.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>
#include <cstddef>

namespace plumb {

/// The greatest principal stretch less 1, of an element of N points.
template <std::size_t N>
inline double greatest_strain(const std::array<Vector3d, N>& rest,
                              const std::array<Vector3d, N>& now) {
    constexpr int kEdges = static_cast<int>(N) - 1;
    using Edges = Eigen::Matrix<double, 3, kEdges>;
    using Metric = Eigen::Matrix<double, kEdges, kEdges>;
    Edges edges, edges_at_rest;
    for (std::size_t k = 1; k < N; ++k) {
        edges.col(static_cast<int>(k) - 1) = now[k] - now[0];
        edges_at_rest.col(static_cast<int>(k) - 1) = rest[k] - rest[0];
    }
    const Eigen::LLT<Metric> root(Metric(edges_at_rest.transpose() * edges_at_rest));
    // L⁻¹ Dᵀ, whose square is G against G₀
    const Eigen::Matrix<double, kEdges, 3> mapped = root.matrixL().solve(edges.transpose());
    const Metric squares = mapped * mapped.transpose();
    const Eigen::SelfAdjointEigenSolver<Metric> solver(squares, Eigen::EigenvaluesOnly);
    return std::sqrt(solver.eigenvalues().maxCoeff()) - 1;
}

}  // namespace plumb
