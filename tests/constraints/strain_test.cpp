// SPDX-License-Identifier: MIT
#include "constraints/strain.h"

#include "support/random.h"

#include <gtest/gtest.h>
#include <Eigen/SVD>

namespace plumb::test {
namespace {

/// The first N of four points, and where a linear map and a shift put them.
template <std::size_t N>
double strain_by(const Matrix3d& map, const std::array<Vector3d, 4>& points) {
    std::array<Vector3d, N> rest, now;
    for (std::size_t i = 0; i < N; ++i)
        rest[i] = points[i], now[i] = map * points[i] + Vector3d(3, -2, 1);
    return greatest_strain(rest, now);
}

/// Of a tetrahedron it is the greatest singular value of the map less 1; of a triangle that of the
/// map in its plane; of a segment how much longer it is.
TEST(Strain, IsTheGreatestStretchOfTheMap) {
    Random random(4);
    for (int draw = 0; draw < 100; ++draw) {
        std::array<Vector3d, 4> p;
        for (Vector3d& x : p) x = random.vector();
        Matrix3d map;
        for (int k = 0; k < 3; ++k) map.col(k) = random.vector();
        const auto greatest = [](const auto& matrix) {
            return Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).singularValues()[0];
        };
        EXPECT_NEAR(strain_by<4>(map, p), greatest(map) - 1, 1e-9);
        Eigen::Matrix<double, 3, 2> plane;
        plane.col(0) = (p[1] - p[0]).normalized();
        plane.col(1) = (p[1] - p[0]).cross(p[2] - p[0]).cross(p[1] - p[0]).normalized();
        EXPECT_NEAR(strain_by<3>(map, p), greatest(map * plane) - 1, 1e-9);
        const Vector3d edge = p[1] - p[0];
        EXPECT_NEAR(strain_by<2>(map, p), (map * edge).norm() / edge.norm() - 1, 1e-12);
        EXPECT_NEAR(strain_by<4>(random.rotation().toRotationMatrix(), p), 0, 1e-9) << "turned";
    }
}

}  // namespace
}  // namespace plumb::test
