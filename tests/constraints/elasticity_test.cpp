// SPDX-License-Identifier: MIT
/// The energy of small strains against Hooke's law, of whole shapes at random: Σ C²/2α.
#include "constraints/formulas.h"
#include "support/random.h"
#include "support/soft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumb::test {
namespace {

Deformable deformable(const DeformableSpec& spec) {
    return {spec, 0, static_cast<std::uint32_t>(spec.points.size())};
}

/// Σ C²/2α of a formula's items, with the points mapped by `place(rest)`.
template <class F, class Place>
double energy(const DeformableSpec& spec, Place place) {
    double sum = 0;
    F::each(deformable(spec), [&](const auto& at, const double(&numbers)[F::kNumbers],
                                  const double(&compliances)[F::kRows]) {
        Vector3d p[F::kPoints];
        for (int i = 0; i < F::kPoints; ++i) p[i] = place(spec.points[at[i]]);
        const auto rows = F::rows(p, numbers);
        for (int k = 0; k < F::kRows; ++k) sum += rows.c[k] * rows.c[k] / (2 * compliances[k]);
    });
    return sum;
}
/// The same of a formula that is linear in its points.
template <class F, class Place>
double linear_energy(const DeformableSpec& spec, Place place) {
    double sum = 0;
    F::each(deformable(spec),
            [&](const auto& at, const double(&weights)[F::kPoints], double compliance) {
                Vector3d c = Vector3d::Zero();
                for (int i = 0; i < F::kPoints; ++i) c += weights[i] * place(spec.points[at[i]]);
                sum += c.squaredNorm() / (2 * compliance);
            });
    return sum;
}

/// Energy of the strain `strain` beyond that of rest, without what changes sign with it.
template <class F>
double strain_energy(const DeformableSpec& spec, const Matrix3d& strain) {
    const auto at = [&](double share) {
        return energy<F>(spec,
                         [&](const Vector3d& p) -> Vector3d { return p + share * strain * p; });
    };
    return 0.5 * (at(1) + at(-1)) - at(0);
}

/// Hooke's energy of a solid, over its volume [J/m³].
double hookes_density(double young, double nu, const Matrix3d& strain) {
    const double mu = young / (2 * (1 + nu)), lame = young * nu / ((1 + nu) * (1 - 2 * nu));
    return mu * strain.squaredNorm() + 0.5 * lame * strain.trace() * strain.trace();
}

Matrix3d random_strain(Random& random, double size) {
    Matrix3d e;
    for (int i = 0; i < 3; ++i) e.col(i) = size * random.vector();
    return 0.5 * (e + e.transpose());
}

/// E and ν of a solid: drawn strains, and each kind alone.
TEST(Elasticity, OfASolidIsHookes) {
    Random random(1);
    for (int draw = 0; draw < 60; ++draw) {
        DeformableSpec spec = block({0.5, 0.3, 0.4}, {2, 2, 3});
        const double young = std::pow(10, random.number(4, 9)), nu = random.number(-0.5, 0.48);
        spec.elasticity.youngs_modulus = young, spec.elasticity.poissons_ratio = nu;
        Matrix3d e = random_strain(random, 1e-4);
        if (draw % 4 == 1) e = 1e-4 * Matrix3d::Identity();       // hydrostatic: 9 K ε² / 2
        if (draw % 4 == 2) e << 0, 1e-4, 0, 1e-4, 0, 0, 0, 0, 0;  // shear: 2 G ε²
        if (draw % 4 == 3)                                        // uniaxial stress: E ε² / 2
            e = Vector3d(1e-4, -nu * 1e-4, -nu * 1e-4).asDiagonal();
        const double volume = 8 * 0.5 * 0.3 * 0.4, law = volume * hookes_density(young, nu, e);
        EXPECT_NEAR(strain_energy<Tetrahedron>(spec, e) / law, 1, 1e-4) << "draw " << draw;
        if (draw % 4 == 1) {
            EXPECT_NEAR(law, 4.5 * young / (3 * (1 - 2 * nu)) * 1e-8 * volume, 1e-9 * law);
        }
        if (draw % 4 == 3) {
            EXPECT_NEAR(law, 0.5 * young * 1e-8 * volume, 1e-9 * law);
        }
    }
}

/// log s, which goes on straight below 0.5 and above 2.5.
double straightened_log(double s) {
    const double some = std::clamp(s, 0.5, 2.5);
    return std::log(some) + (s - some) / some;
}

/// Stretched to several times its size, pressed flat or turned inside out, and turned in space:
/// still V (μ |dev (S − 1)|² + ½ K C²), of stretches that are told apart from a rotation, with C
/// between the logarithm of the volume and the sum of the strains.
TEST(Elasticity, OfASolidTurnsWithItAndKnowsItsVolume) {
    Random random(3);
    for (int draw = 0; draw < 60; ++draw) {
        DeformableSpec spec = block({0.5, 0.3, 0.4}, {2, 2, 3});
        const double young = std::pow(10, random.number(4, 9)), nu = random.number(-0.5, 0.48);
        spec.elasticity.youngs_modulus = young, spec.elasticity.poissons_ratio = nu;
        const double least = draw % 3 == 0 ? 0 : random.number(-0.3, 0.3);
        const Vector3d stretch(random.number(0.4, 4), random.number(0.4, 4), least);
        const Matrix3d axes = random.rotation().toRotationMatrix(),
                       turn = random.rotation().toRotationMatrix(),
                       s = axes * stretch.asDiagonal() * axes.transpose();
        const Vector3d e = stretch - Vector3d::Ones();
        const double mean = e.sum() / 3, w = std::max(0.0, 3 * nu / (1 + nu));
        double c = 0;
        for (const double x : stretch) c += w * straightened_log(x) + (1 - w) * (x - 1);
        const double mu = young / (2 * (1 + nu)), bulk = young / (3 * (1 - 2 * nu));
        const double law = 8 * 0.5 * 0.3 * 0.4 *
                           (mu * (e - Vector3d::Constant(mean)).squaredNorm() + 0.5 * bulk * c * c);
        const double seen =
            energy<Tetrahedron>(spec, [&](const Vector3d& p) -> Vector3d { return turn * s * p; });
        EXPECT_NEAR(seen / law, 1, 1e-9) << "draw " << draw;
    }
}

/// E, ν and thickness of a sheet in plane stress; in-plane strains, turned in space.
TEST(Elasticity, OfASheetIsHookesInPlaneStress) {
    Random random(2);
    for (int draw = 0; draw < 60; ++draw) {
        DeformableSpec spec = sheet({3, 4}, {0.7, 0.5});
        const double young = std::pow(10, random.number(4, 9)), nu = random.number(-0.9, 0.9);
        spec.elasticity.youngs_modulus = young, spec.elasticity.poissons_ratio = nu;
        spec.thickness = random.number(1e-4, 1e-2);
        Matrix3d e = random_strain(random, 1e-4);
        e.row(1).setZero(), e.col(1).setZero();
        if (draw % 3 == 1)  // uniaxial stress: E ε² / 2
            e.setZero(), e(0, 0) = 1e-4, e(2, 2) = -nu * 1e-4;
        const double x = e(0, 0), z = e(2, 2), xz = e(0, 2);
        const double density =
            young / (2 * (1 - nu * nu)) * (x * x + z * z + 2 * nu * x * z + 2 * (1 - nu) * xz * xz);
        const Matrix3d turn = random.rotation().toRotationMatrix();
        const double law = density * 0.7 * 0.5 * spec.thickness;
        const auto at = [&](double share) {
            return energy<Membrane>(
                spec, [&](const Vector3d& p) -> Vector3d { return turn * (p + share * e * p); });
        };
        EXPECT_LT(at(0), 1e-12 * law);
        EXPECT_NEAR(0.5 * (at(1) + at(-1)) / law, 1, 1e-4) << "draw " << draw;
        if (draw % 3 == 1) {
            EXPECT_NEAR(law, 0.5 * young * 1e-8 * 0.7 * 0.5 * spec.thickness, 1e-9 * law);
        }
    }
}

/// A sheet that is rolled up: B κ²/2 over the area that its inner edges stand for.
TEST(Elasticity, OfARolledSheetIsThatOfAPlate) {
    const double rigidity = 0.02, radius = 2, length = 0.6, width = 0.4;
    const std::uint32_t rows = 30;
    DeformableSpec spec = sheet({5, rows}, {width, length});
    spec.elasticity.bending_stiffness = rigidity;
    const auto roll = [&](const Vector3d& p) -> Vector3d {
        const double angle = p.z() / radius;
        return {p.x(), radius * (1 - std::cos(angle)), radius * std::sin(angle)};
    };
    const double area = width * length * (rows - 1.0) / rows;  // the outer rows have no edge
    EXPECT_NEAR(
        linear_energy<IsometricBend>(spec, roll) / (0.5 * rigidity / (radius * radius) * area), 1,
        0.001);
}

/// E t³ / 12 (1 − ν²), and E I with the I of a circle, where nothing else is said.
TEST(Elasticity, BendingStiffnessIsThatOfTheMaterial) {
    DeformableSpec cloth = sheet({1, 1}, {1, 1});
    cloth.thickness = 0.002, cloth.elasticity.youngs_modulus = 3e6;
    cloth.elasticity.poissons_ratio = 0.25;
    EXPECT_NEAR(cloth_bending_stiffness(cloth), 3e6 * 8e-9 / (12 * (1 - 0.0625)), 1e-12);
    DeformableSpec line = rope({0, 0, 0}, {1, 0, 0}, 2);
    line.thickness = 0.02, line.elasticity.youngs_modulus = 3e8;
    EXPECT_NEAR(rope_bending_stiffness(line), 3e8 * std::numbers::pi * std::pow(0.02, 4) / 64,
                1e-9);
    cloth.elasticity.bending_stiffness = line.elasticity.bending_stiffness = 7;
    EXPECT_EQ(cloth_bending_stiffness(cloth), 7);
    EXPECT_EQ(rope_bending_stiffness(line), 7);
}

/// A rope bent to a circle, of segments of drawn lengths: E I κ²/2 over the length.
TEST(Elasticity, OfABentRopeIsThatOfARod) {
    Random random(3);
    const double stiffness = 0.3, radius = 1.5;
    DeformableSpec spec;
    spec.kind = DeformableKind::rope;
    spec.elasticity.bending_stiffness = stiffness;
    double at = 0, first = 0, last = 0;
    for (std::uint32_t i = 0; i < 200; ++i) {
        spec.points.push_back({at, 0, 0});
        if (i > 0) spec.segments.push_back({i - 1, i});
        last = random.number(0.008, 0.012);
        if (i == 0) first = last;
        if (i < 199) at += last;
    }
    last = at - spec.points[198].x();
    const auto bend = [&](const Vector3d& p) -> Vector3d {
        return {radius * std::sin(p.x() / radius), radius * std::cos(p.x() / radius), 0};
    };
    const double length = at - 0.5 * (first + last);
    EXPECT_NEAR(
        linear_energy<RopeBend>(spec, bend) / (0.5 * stiffness / (radius * radius) * length), 1,
        0.001);
    const auto straight = [](const Vector3d& p) -> Vector3d { return p; };
    EXPECT_LT(linear_energy<RopeBend>(spec, straight), 1e-20);
}

/// A rope under a small strain: E A ε²/2 over its length.
TEST(Elasticity, OfAStretchedRopeIsHookes) {
    DeformableSpec spec = rope({0, 0, 0}, {0, -2, 0}, 7);
    spec.thickness = 0.01, spec.elasticity.youngs_modulus = 2e6;
    const double section = std::numbers::pi * 0.01 * 0.01 / 4, strain = 1e-3;
    EXPECT_NEAR(
        energy<Stretch>(spec, [&](const Vector3d& p) -> Vector3d { return (1 + strain) * p; }),
        0.5 * 2e6 * section * strain * strain * 2, 1e-9);
}

}  // namespace
}  // namespace plumb::test
