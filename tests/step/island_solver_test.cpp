// SPDX-License-Identifier: MIT
/// Islands against the law of contact: a pile of rods in a tray, whose contacts are found anew, a
/// little beside where they were, before each substep.
#include "step/island_solver.h"
#include "support/random.h"

#include "constraints/connector.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb {
namespace {

using test::Random;

constexpr double kRadius = 0.15, kHalfLength = 0.6, kMass = 20;
constexpr double kSpeed = 9.81 * 0.01;  // that gravity makes in a substep of 10 ms
constexpr double kGap = 1.04;           // from rod to rod in a row, of a diameter
const Vector3d kUp(0, 1, 0), kEast(1, 0, 0);

/// Rods along z in rows, each in the hollow between two of the row below; walls hold the lowest.
struct RodPile {
    std::vector<Vector3d> centres;
    std::vector<IslandBody> bodies;
    std::vector<IslandPoint> points;
    std::vector<Vector6d> velocity;
    BlockCholesky system;

    RodPile(int width, int rows) {
        BlockCholesky::Pattern pairs;
        const double rise = std::sqrt(4 - kGap * kGap) * kRadius;
        std::vector<std::uint32_t> below, row;
        for (int j = 0; j < rows; ++j, below.swap(row)) {
            row.clear();
            for (int i = 0; i < width - j; ++i) {
                row.push_back(add_rod({(2 * i + j) * kGap * kRadius, kRadius + j * rise, 0}));
                const Vector3d x = centres.back();
                if (j == 0) {
                    touch(row.back(), kImmovable, x - kRadius * kUp, kUp);
                    if (i == 0) touch(row.back(), kImmovable, x - kRadius * kEast, kEast);
                    if (i == width - 1) touch(row.back(), kImmovable, x + kRadius * kEast, -kEast);
                    continue;
                }
                for (const int side : {0, 1}) {
                    const std::uint32_t under = below[static_cast<std::size_t>(i + side)];
                    const Vector3d normal = (x - centres[under]).normalized();
                    touch(row.back(), under, x - kRadius * normal, normal);
                    pairs.emplace_back(under, row.back());
                }
            }
        }
        system.analyse(static_cast<std::uint32_t>(bodies.size()), pairs);
        velocity.resize(bodies.size());
    }

    Island island() { return {bodies, velocity, points}; }

    /// Gravity, and the impulses of the substep before, at arms moved by up to `shift` [m].
    void begin(Random& random, double shift) {
        std::vector<Vector6d> force(bodies.size(), Vector6d::Zero());
        for (IslandPoint& p : points) {
            const Vector3d by = random.vector(shift);
            p.arm_a += by, p.arm_b += by;
            add_impulse(p, p.impulse, force);
        }
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            velocity[i] = response(bodies[i], force[i]);
            velocity[i].head<3>() -= kSpeed * kUp;
        }
    }

private:
    std::uint32_t add_rod(const Vector3d& centre) {
        const auto index = static_cast<std::uint32_t>(bodies.size());
        const double about = 0.5 * kMass * kRadius * kRadius,
                     across = 0.5 * about + kMass * kHalfLength * kHalfLength / 3;
        IslandBody& body = bodies.emplace_back();
        body.body = index, body.mass = kMass;
        body.inertia = {across, across, about, 0, 0, 0};
        body.inverse_inertia = {1 / across, 1 / across, 1 / about, 0, 0, 0};
        centres.push_back(centre);
        return index;
    }

    void touch(std::uint32_t a, std::uint32_t b, const Vector3d& at, const Vector3d& normal) {
        for (const double z : {-kHalfLength, kHalfLength}) {
            IslandPoint& p = points.emplace_back();
            const Vector3d x = at + z * Vector3d::UnitZ();
            const InverseMass<double> of_a{1 / kMass, bodies[a].inverse_inertia},
                none{0, {0, 0, 0, 0, 0, 0}},
                of_b = b == kImmovable ? none
                                       : InverseMass<double>{1 / kMass, bodies[b].inverse_inertia};
            p.a = a, p.b = b;
            p.frame << normal, Vector3d::UnitZ(), normal.cross(Vector3d::UnitZ());
            p.arm_a = x - centres[a];
            p.arm_b = b == kImmovable ? Vector3d(0, 0, 0) : Vector3d(x - centres[b]);
            const Symmetric3<double> k =
                point_response(of_a, p.arm_a) + point_response(of_b, p.arm_b);
            p.mass = 1 / (k.xx + k.yy + k.zz);
            p.mass_normal = 1 / (response(of_a, p.arm_a, normal, normal) +
                                 response(of_b, p.arm_b, normal, normal));
            p.length = kRadius;
            p.cone = {0.5, 0, 0.001 / p.length, 1e3 * kMass};
            p.wanted.setZero(), p.impulse.setZero();
        }
    }
};

/// From nothing, the forces of a pile take a few substeps to find; from then on they are held,
/// however the contacts shift.
TEST(IslandSolver, HoldsRodsWhoseContactsShiftALittle) {
    constexpr int kToFind = 5;
    for (const int width : {4, 8, 14}) {
        RodPile pile(width, width - 1);
        IslandSolver solver;
        Random random(7);
        for (int substep = 0; substep < 100; ++substep) {
            pile.begin(random, substep == 0 ? 0 : 1e-6);
            const IslandReport report = solver.solve(pile.island(), pile.system, kSpeed);
            if (substep < kToFind) continue;
            EXPECT_TRUE(report.solved)
                << width << " wide, substep " << substep << ": " << report.residual / kSpeed;
        }
        double borne = 0;  // by ground and walls [N s]
        for (const IslandPoint& p : pile.points)
            if (p.b == kImmovable) borne += (p.frame * p.impulse.head<3>()).y();
        EXPECT_NEAR(borne / (kMass * kSpeed * static_cast<double>(pile.bodies.size())), 1, 1e-6);
    }
}

}  // namespace
}  // namespace plumb
