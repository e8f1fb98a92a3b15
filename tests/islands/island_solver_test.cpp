// SPDX-License-Identifier: MIT
/// Islands against the law of contact: a pile of rods in a tray, whose contacts are found anew, a
/// little beside where they were, before each substep. And rows of joints against sums of momentum.
#include "islands/island_solver.h"
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
    std::vector<SolvedBody> bodies;
    std::vector<IslandPoint> points;
    std::vector<Vector6d> velocity;
    IslandSystem system;
    IslandSystem::Spare spare;

    RodPile(int width, int rows) {
        IslandSystem::Pattern pairs;
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
        system.analyse(static_cast<std::uint32_t>(bodies.size()), pairs, false, kAnyProducts,
                       spare);
        velocity.resize(bodies.size());
    }

    Island island() { return {bodies, velocity, points, {}}; }

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
        SolvedBody& body = bodies.emplace_back();
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

/// Balls in a row along x, each held to the next by a rod, and what drives the last against the
/// world.
struct Train {
    std::vector<SolvedBody> bodies;
    std::vector<TieRow> rows;
    std::vector<IslandPoint> points;
    std::vector<Vector6d> velocity;
    AxisDrive drive;
    IslandSystem system;
    IslandSystem::Spare spare;

    explicit Train(std::uint32_t count) : velocity(count, Vector6d::Zero()) {
        IslandSystem::Pattern pairs;
        for (std::uint32_t i = 0; i < count; ++i) {
            SolvedBody& body = bodies.emplace_back();
            body.body = i, body.mass = i + 1.0;
            body.inertia = body.inverse_inertia = {1, 1, 1, 0, 0, 0};
            if (i > 0) add_row(i, i - 1), pairs.emplace_back(i, i - 1);
        }
        add_row(count - 1, kImmovable);
        rows.back().drive = &drive;
        system.analyse(count, pairs, false, kAnyProducts, spare);
    }
    double mass() const { return 0.5 * double(bodies.size() * (bodies.size() + 1)); }
    Island island() { return {bodies, velocity, points, rows}; }

private:
    void add_row(std::uint32_t a, std::uint32_t b) {
        TieRow& row = rows.emplace_back();
        row.most = 1e6;
        const Vector6d along = Vector6d::Unit(0);
        row.add_side(a, along), row.add_side(b, -along);
        row.mass = 1 / (1 / bodies[a].mass + (b == kImmovable ? 0 : 1 / bodies[b].mass));
    }
};

TEST(IslandSolver, RowsShareMomentumAsAllMassesTogether) {
    for (const std::uint32_t count : {2u, 5u, 40u}) {
        Train train(count);
        train.velocity[0][0] = 3;
        IslandSolver solver;
        EXPECT_TRUE(solver.solve(train.island(), train.system, 3).solved);
        for (const Vector6d& v : train.velocity) EXPECT_NEAR(v[0], 3 / train.mass(), 1e-6);
    }
}

/// Friction that is strong enough stops the train and bears what it had; one that is too weak bears
/// its bound, and no more.
TEST(IslandSolver, DrivesHoldUpToTheirBounds) {
    constexpr std::uint32_t count = 12;
    for (const double share : {0.1, 0.9, 1.1, 50.0}) {
        Train train(count);
        const double momentum = 2 * train.mass();
        train.drive.add({0, 0, -share * momentum, share * momentum});
        for (Vector6d& v : train.velocity) v[0] = 2;
        IslandSolver solver;
        EXPECT_TRUE(solver.solve(train.island(), train.system, 2).solved) << share;
        EXPECT_NEAR(train.rows.back().impulse, -std::min(share, 1.0) * momentum, 1e-6 * momentum);
        for (const Vector6d& v : train.velocity)
            EXPECT_NEAR(v[0], 2 * (1 - std::min(share, 1.0)), 1e-5) << share;
    }
}

/// Ropes pull and do not push: a train that is pulled apart stays together, one that is pushed
/// together closes up.
TEST(IslandSolver, RopesPullAndDoNotPush) {
    for (const bool pulled : {true, false}) {
        Train train(6);
        for (TieRow& row : train.rows)
            if (!row.drive) row.highest = 0;
        train.velocity[pulled ? 5 : 0][0] = 3;  // the last is at the front
        IslandSolver solver;
        EXPECT_TRUE(solver.solve(train.island(), train.system, 3).solved);
        for (std::size_t i = 0; i < 6; ++i)
            EXPECT_NEAR(train.velocity[i][0], pulled ? 18 / train.mass() : i == 0 ? 3 : 0, 1e-5);
        for (const TieRow& row : train.rows)
            if (!row.drive) {
                EXPECT_LE(row.impulse, 0);
            }
    }
}

/// A row of four bodies, as of two coupled joints: v₀ − v₁ = v₂ − v₃.
TEST(IslandSolver, ARowHasUpToFourBodies) {
    Train train(4);
    train.rows.resize(1);
    TieRow& row = train.rows[0];
    row.count = 0, row.mass = 0;
    for (std::uint32_t i = 0; i < 4; ++i) {
        row.add_side(i, (i == 0 || i == 3 ? 1 : -1) * Vector6d::Unit(0));
        row.mass += 1 / train.bodies[i].mass;
    }
    row.mass = 1 / row.mass;
    IslandSystem::Pattern all;
    for (std::uint32_t i = 0; i < 4; ++i)
        for (std::uint32_t j = 0; j < i; ++j) all.emplace_back(i, j);
    train.system.analyse(4, all, false, kAnyProducts, train.spare);
    train.velocity[0][0] = 3;
    IslandSolver solver;
    EXPECT_TRUE(solver.solve(train.island(), train.system, 3).solved);
    const std::vector<Vector6d>& v = train.velocity;
    EXPECT_NEAR(v[0][0] - v[1][0] - v[2][0] + v[3][0], 0, 1e-6);
    EXPECT_NEAR(row.impulse, -3 * row.mass, 1e-5);
}

/// Two rods between the same balls that ask for different things: bounded, and the mean of both.
TEST(IslandSolver, RowsThatContradictEachOtherMeetInTheMiddle) {
    Train train(2);
    train.rows.push_back(train.rows[0]);
    train.rows[0].wanted = 1e-3, train.rows[2].wanted = -1e-3;
    for (TieRow& row : train.rows) row.softness = row.drive ? 0 : 1e-4;
    IslandSolver solver;
    solver.solve(train.island(), train.system, 1);
    EXPECT_NEAR(train.velocity[0][0], 0, 1e-6);
    EXPECT_NEAR(train.velocity[1][0], 0, 1e-6);
    EXPECT_LT(std::abs(train.rows[0].impulse), 11) << "1e-3/1e-4";
}

}  // namespace
}  // namespace plumb
