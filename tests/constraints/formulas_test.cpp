// SPDX-License-Identifier: MIT
/// Gradients of what deformables are made of against central differences, and what a block does to
/// a shape at rest.
#include "constraints/formulas.h"
#include "support/random.h"

#include <gtest/gtest.h>
#include <Eigen/SVD>

#include <cmath>

namespace plumb {
namespace {

using test::Random;

template <class F>
using Numbers = double[F::kNumbers];

/// The greatest difference between a gradient and central differences of C, over the gradient.
template <class F>
double gradient_error(const Vector3d (&points)[F::kPoints], const Numbers<F>& numbers) {
    constexpr double kStep = 1e-6;
    const auto rows = F::rows(points, numbers);
    double error = 0, size = 0;
    for (int i = 0; i < F::kPoints; ++i)
        for (int k = 0; k < 3; ++k) {
            Vector3d moved[F::kPoints];
            const auto row_at = [&](double step) {
                for (int j = 0; j < F::kPoints; ++j) moved[j] = points[j];
                moved[i][k] += step;
                return F::rows(moved, numbers);
            };
            const auto ahead = row_at(kStep), behind = row_at(-kStep);
            for (int r = 0; r < F::kRows; ++r) {
                const double slope = (ahead.c[r] - behind.c[r]) / (2 * kStep);
                error = std::max(error, std::abs(slope - rows.gradient[r][i][k]));
                size = std::max(size, std::abs(rows.gradient[r][i][k]));
            }
        }
    return error / size;
}

/// No row changes when all points move alike.
template <class F>
double gradient_sum(const Vector3d (&points)[F::kPoints], const Numbers<F>& numbers) {
    const auto rows = F::rows(points, numbers);
    double worst = 0;
    for (int r = 0; r < F::kRows; ++r) {
        Vector3d sum = Vector3d::Zero();
        double size = 0;
        for (const Vector3d& g : rows.gradient[r]) sum += g, size += g.norm();
        worst = std::max(worst, sum.norm() / size);
    }
    return worst;
}

template <int N>
void draw(Random& random, Vector3d (&points)[N]) {
    for (Vector3d& p : points) p = random.vector();
}

TEST(Stretch, GradientIsThatOfTheLength) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        Vector3d p[2];
        draw(random, p);
        const Numbers<Stretch> numbers = {random.number(0.1, 2)};
        EXPECT_NEAR(Stretch::rows(p, numbers).c[0], (p[1] - p[0]).norm() - numbers[0], 1e-14);
        EXPECT_LT(gradient_error<Stretch>(p, numbers), 1e-7);
        EXPECT_LT(gradient_sum<Stretch>(p, numbers), 1e-14);
    }
}

TEST(Membrane, GradientIsThatOfTheStrain) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        Vector3d p[3];
        draw(random, p);
        const Numbers<Membrane> numbers = {random.number(0.5, 2), random.number(-1, 1),
                                           random.number(0.5, 2)};
        EXPECT_LT(gradient_error<Membrane>(p, numbers), 1e-7);
        EXPECT_LT(gradient_sum<Membrane>(p, numbers), 1e-14);
    }
}

/// How the corners of a tetrahedron with the inverse of its edges at rest are mapped.
Matrix3d map_of(const Vector3d (&p)[4], const Numbers<Tetrahedron>& inverse) {
    Matrix3d edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = p[k + 1] - p[0];
    return edges * Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(inverse);
}

TEST(Tetrahedron, GradientIsThatOfTheStretches) {
    Random random(3);
    int seen = 0;
    for (int i = 0; i < 400; ++i) {
        Vector3d p[4];
        draw(random, p);  // half of them inside out
        Numbers<Tetrahedron> numbers;
        for (double& x : numbers) x = random.number(-1, 1);
        EXPECT_LT(gradient_sum<Tetrahedron>(p, numbers), 1e-13);
        const Matrix3d f = map_of(p, numbers);
        const Vector3d s = Eigen::JacobiSVD<Matrix3d>(f).singularValues();
        // where a face turns over, S changes without bound
        if (s[1] + (f.determinant() < 0 ? -s[2] : s[2]) < 0.11) continue;
        ++seen;
        EXPECT_LT(gradient_error<Tetrahedron>(p, numbers), 1e-6);
    }
    EXPECT_GT(seen, 200);
}

/// Turned as a whole, also where it is flat, thin or inside out, no row changes: no torque.
TEST(Tetrahedron, NoRowHasATorque) {
    Random random(8);
    for (int i = 0; i < 400; ++i) {
        Vector3d p[4];
        draw(random, p);
        if (i % 4 == 1) p[3] = p[0] + 0.3 * (p[1] - p[0]) - 2 * (p[2] - p[0]);
        if (i % 4 == 2) p[2] = p[0] - 2 * (p[1] - p[0]), p[3] = 0.5 * (p[0] + p[1]);
        if (i % 4 == 3) p[3] = p[0] - 0.01 * (p[3] - p[0]);
        Numbers<Tetrahedron> numbers;
        for (double& x : numbers) x = random.number(-1, 1);
        const auto rows = Tetrahedron::rows(p, numbers);
        for (int r = 0; r < 6; ++r) {
            Vector3d torque = Vector3d::Zero();
            double size = 0;
            for (int k = 0; k < 4; ++k) {
                ASSERT_TRUE(rows.gradient[r][k].allFinite());
                torque += p[k].cross(rows.gradient[r][k]);
                size += p[k].norm() * rows.gradient[r][k].norm();
            }
            EXPECT_LT(torque.norm(), 2e-6 * size) << "draw " << i << " row " << r;
            if (i % 4 == 0) {
                EXPECT_LT(torque.norm(), 1e-12 * size) << "draw " << i << " row " << r;
            }
        }
    }
}

TEST(DihedralBend, GradientIsThatOfTheHalfAnglesSine) {
    Random random(4);
    int seen = 0;
    for (int i = 0; i < 400; ++i) {
        Vector3d p[4];
        draw(random, p);
        const double rest = random.number(-3, 3);
        const Numbers<DihedralBend> numbers = {std::sin(rest), std::cos(rest)};
        const bending::EdgeAngle angle = bending::angle_at(p);
        const double apart = std::atan2(angle.sine, angle.cosine) - rest;
        // the sine of the half ends at half a turn, and thin triangles have no steady normal
        const double height = std::min((p[1] - p[0]).cross(p[2] - p[0]).norm(),
                                       (p[1] - p[0]).cross(p[3] - p[0]).norm());
        if (std::abs(std::cos(apart / 2)) < 0.05 || height < 0.3) continue;
        ++seen;
        EXPECT_LT(gradient_error<DihedralBend>(p, numbers), 1e-5);
        EXPECT_LT(gradient_sum<DihedralBend>(p, numbers), 1e-12);
    }
    EXPECT_GT(seen, 200);
}

/// What one block does to points at rest: the greatest velocity, over 1 m/s and what its rows would
/// do to them one by one.
template <class F>
double push_at_rest(const Vector3d (&points)[F::kPoints], const Numbers<F>& numbers,
                    const double (&compliances)[F::kRows], Random& random) {
    const double h = random.number(1e-4, 0.02), damping = random.number(0, 0.1);
    const auto rows = F::rows(points, numbers);
    Vector3d velocity[F::kPoints];
    double inverse_mass[F::kPoints], lag[F::kRows], softness[F::kRows], impulse[F::kRows];
    for (int i = 0; i < F::kPoints; ++i)
        velocity[i].setZero(), inverse_mass[i] = random.number(0, 10);
    for (int k = 0; k < F::kRows; ++k) {
        lag[k] = point_lag(damping, h) * rows.c[k];
        softness[k] = point_softness(compliances[k], damping, h);
        impulse[k] = 0;
    }
    double fastest = 0, pushes = 1;
    for (int sweep = 0; sweep < 3; ++sweep) {
        solve_points<double, F::kPoints, F::kRows>(velocity, inverse_mass, rows, lag, softness,
                                                   impulse, h);
        for (const Vector3d& v : velocity) fastest = std::max(fastest, v.norm());
    }
    for (int k = 0; k < F::kRows; ++k)
        for (int i = 0; i < F::kPoints; ++i)
            pushes += inverse_mass[i] * std::abs(impulse[k]) * rows.gradient[k][i].norm();
    return fastest / pushes;
}

/// Each element of the only kind in a spec, at rest and turned.
template <class F>
void expect_rest(const DeformableSpec& spec, double share, Random& random) {
    Deformable d{spec, 0, static_cast<std::uint32_t>(spec.points.size())};
    int seen = 0;
    F::each(d,
            [&](const auto& at, const Numbers<F>& numbers, const double(&compliances)[F::kRows]) {
                const Quaterniond turn = random.rotation();
                Vector3d p[F::kPoints];
                for (int i = 0; i < F::kPoints; ++i) p[i] = turn * spec.points[at[i]];
                EXPECT_LT(push_at_rest<F>(p, numbers, compliances, random), share);
                ++seen;
            });
    EXPECT_GT(seen, 0);
}

/// Nothing but rounding.
TEST(Tetrahedron, AtRestNothingMoves) {
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        DeformableSpec spec;
        spec.kind = DeformableKind::solid;
        for (int k = 0; k < 4; ++k) spec.points.push_back(random.vector());
        const Vector3d o = spec.points[0];
        const double volume =
            (spec.points[1] - o).cross(spec.points[2] - o).dot(spec.points[3] - o) / 6;
        if (std::abs(volume) < 0.05) continue;
        spec.tetrahedra = {{0, 1, 2, 3}};
        if (volume < 0) std::swap(spec.tetrahedra[0][0], spec.tetrahedra[0][1]);
        spec.elasticity.youngs_modulus = std::pow(10, random.number(3, 9));
        spec.elasticity.poissons_ratio = random.number(-0.5, 0.45);
        expect_rest<Tetrahedron>(spec, 1e-11, random);
    }
}

TEST(Membrane, AtRestNothingMoves) {
    Random random(6);
    for (int i = 0; i < 200; ++i) {
        DeformableSpec spec;
        spec.kind = DeformableKind::cloth;
        for (int k = 0; k < 3; ++k) spec.points.push_back(random.vector());
        spec.triangles = {{0, 1, 2}};
        expect_rest<Membrane>(spec, 1e-12, random);
    }
}

TEST(DihedralBend, AtRestNothingMoves) {
    Random random(7);
    for (int i = 0; i < 200; ++i) {
        DeformableSpec spec;
        spec.kind = DeformableKind::cloth;
        for (int k = 0; k < 4; ++k) spec.points.push_back(random.vector());
        spec.triangles = {{0, 1, 2}, {1, 0, 3}};
        expect_rest<DihedralBend>(spec, 1e-12, random);
    }
}

/// A step of one block with compliance: C at its end is −α f with the force f = P/h, and with
/// damping C + τ dC/dt is.
TEST(PointRows, OneBlockObeysItsCompliance) {
    Random random(8);
    for (int i = 0; i < 200; ++i) {
        const double h = random.number(1e-3, 0.02), compliance = std::pow(10, random.number(-6, 0)),
                     damping = i % 2 == 0 ? 0 : random.number(0, 0.1);
        LinearRow<double, 3> row{{random.number(-1, 1), random.number(-1, 1), 1}};
        Vector3d place[3], velocity[3], before = Vector3d::Zero(), impulse = Vector3d::Zero();
        double inverse_mass[3];
        for (int k = 0; k < 3; ++k) {
            place[k] = random.vector(), velocity[k] = random.vector();
            inverse_mass[k] = random.number(0.1, 2);
            before += row.weight[k] * place[k];
        }
        const auto at_end = [&] {
            Vector3d c = Vector3d::Zero();
            for (int k = 0; k < 3; ++k) c += row.weight[k] * (place[k] + h * velocity[k]);
            return c;
        };
        for (int sweep = 0; sweep < 2; ++sweep) {  // the second has nothing left to do
            solve_points<double, 3>(velocity, inverse_mass, row, at_end(),
                                    Vector3d(point_lag(damping, h) * before),
                                    point_softness(compliance, damping, h), impulse, h);
            const Vector3d c = at_end(), rate = (c - before) / h;
            EXPECT_LT((c + damping * rate + compliance * impulse / h).norm(),
                      1e-11 * (1 + compliance * impulse.norm() / h));
        }
    }
}

}  // namespace
}  // namespace plumb
