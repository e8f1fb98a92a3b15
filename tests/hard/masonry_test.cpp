// SPDX-License-Identifier: MIT
/// Dry masonry and leaning boards stand for as long as statics says that they can, and fall where
/// it says that they must, at default settings with steps of 0.01 and 1/60 s.
#include "support/masonry.h"
#include "support/environment.h"
#include "support/structures.h"

#include <cmath>

namespace plumb::test {
namespace {

const double kSeconds = number_from("PLUMB_STRUCTURE_SECONDS", 12);

/// Share of its size by which nothing of what stands may have come, and everything that falls has
/// moved at least somewhere.
constexpr double kSag = 1e-3, kFallen = 0.1;

/// Statics is asked at this share of a limit, and its inverse.
constexpr double kShort = 0.9, kBeyond = 1.1;

/// How far any body has come after a while [m].
double farthest_after(const Scene& scene, const std::string& collider, double seconds) {
    Simulation simulation(scene, colliders(), collider);
    const std::vector<Vector> start = simulation.world().bodies.position;
    run_for(simulation, seconds);
    return farthest_from(start, simulation.world());
}

/// Stones of 2400 kg/m³ on ground.
Scene with_friction(Scene s, double friction) {
    s.materials[0].density = 2400;
    s.materials[0].friction = friction;
    return s;
}

void expect_stands(Scene s, const std::string& collider, double size, const std::string& name,
                   double seconds = kSeconds) {
    for (const double dt : {0.01, 1.0 / 60}) {
        s.settings.dt = dt;
        EXPECT_LT(farthest_after(s, collider, seconds), kSag * size) << name << ", " << dt << " s";
    }
}
void expect_falls(Scene s, const std::string& collider, double size, const std::string& name) {
    for (const double dt : {0.01, 1.0 / 60}) {
        s.settings.dt = dt;
        EXPECT_GT(farthest_after(s, collider, 5), kFallen * size) << name << ", " << dt << " s";
    }
}

/// Those that do hulls.
class Stones : public OnEveryCollider {
protected:
    void SetUp() override {
        if (collider() == "reference") GTEST_SKIP() << "it has no hulls";
    }
};
INSTANTIATE_TEST_SUITE_P(, Stones, every_collider(), where_name);

class Boards : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Boards, every_collider(), where_name);

Scene scene_of(const Scene& empty, const Arch& arch, double friction) {
    Scene s = with_friction(empty, friction);
    add_arch(s, arch);
    return s;
}

TEST(Masonry, StaticsKnowsTheThinnestArch) {
    // a semicircle of infinitely many stones: 0.1075 of its radius (Milankovitch 1907)
    Arch arch;
    arch.stones = 2001;
    EXPECT_NEAR(least_thickness(arch, 10) / arch.radius, 0.1075, 2e-4);
    // a block between two rough walls: each bears half of its weight
    Arch block;
    block.stones = 1, block.half = 1e-3;
    EXPECT_LT(least_friction(block), 1e-2);
}

TEST_P(Stones, ArchesStandAndFallWithTheirThickness) {
    for (const double half : {90, 75, 60})
        for (const int stones : {11, 21}) {
            Arch arch;
            arch.stones = stones, arch.half = half * std::numbers::pi / 180;
            const double friction = 1.2, least = least_thickness(arch, friction);
            const std::string name =
                std::to_string(stones) + " stones over " + std::to_string(2 * half) + " degrees";
            arch.thickness = least / kShort;
            expect_stands(scene_of(scene(), arch, friction), collider(), 2 * arch.radius, name);
            arch.thickness = least / kBeyond;
            expect_falls(scene_of(scene(), arch, friction), collider(), arch.radius, name);
        }
}

TEST_P(Stones, ArchesStandAndFallWithTheirFriction) {
    for (const double half : {90, 60, 40}) {
        Arch arch;
        arch.stones = 15, arch.half = half * std::numbers::pi / 180;
        const double least = least_friction(arch);
        const std::string name =
            "over " + std::to_string(2 * half) + " degrees, limit " + std::to_string(least);
        expect_stands(scene_of(scene(), arch, least / kShort), collider(), 2 * arch.radius, name);
        expect_falls(scene_of(scene(), arch, least / kBeyond), collider(), arch.radius, name);
    }
}

/// Six rings of 11 stones, every other one shifted by half a stone: 66 stones.
TEST_P(Stones, ABarrelVaultStands) {
    Scene s = with_friction(scene(), 0.7);
    Arch arch;
    arch.thickness = 0.4;
    for (int ring = 0; ring < 6; ++ring) {
        const double z = ring * arch.width;
        arch.stones = 11;
        if (ring % 2 == 0) {
            for (int i = 0; i < 11; ++i)
                add_prism(s, arch.between(arch.joint(i), arch.joint(i + 1)), arch.width, z);
            continue;
        }
        const double stone = std::numbers::pi / 11;
        for (int i = 0; i <= 11; ++i)
            add_prism(s,
                      arch.between(std::max(0.0, (i - 0.5) * stone),
                                   std::min(std::numbers::pi, (i + 0.5) * stone)),
                      arch.width, z);
    }
    add_body(s, box(4, 0.5, 4), {0, -0.5, 1}, Motion::fixed);
    expect_stands(s, collider(), 2 * arch.radius, "vault");
}

/// Half an arch leans from a pier against the tower that it is there to hold.
TEST_P(Stones, AFlyingButtressStands) {
    Scene s = with_friction(scene(), 0.7);
    add_ground(s);
    constexpr double kPier = 1.6;
    for (int i = 0; i < 4; ++i)
        add_body(s, box(0.4, kPier / 8, 0.25), {2, kPier / 8 * (2 * i + 1), 0});
    Arch arch;
    arch.stones = 18, arch.thickness = 0.35;
    for (int i = 0; i < 9; ++i) {
        Outline stone = arch.between(arch.joint(i), arch.joint(i + 1));
        for (Eigen::Vector2d& p : stone) p.y() += kPier;
        add_prism(s, stone, arch.width);
    }
    constexpr int kBlocks = 8;
    const double half = (kPier + arch.radius + 1.2) / kBlocks / 2;
    for (int i = 0; i < kBlocks; ++i)
        add_body(s, box(0.6, half, 0.5), {-0.6, half * (2 * i + 1), 0});
    expect_stands(s, collider(), arch.radius, "buttress");
}

/// An arch of 17 stones with a pillar on each, a road of slabs on these, and roads on either side;
/// a cart of four wheels rolls over it. Stones, pillars, slabs.
constexpr int kBridge = 17 + 17 + 11;
Scene bridge(const Scene& empty) {
    Scene s = with_friction(empty, 0.7);
    Arch arch;
    arch.stones = 17, arch.radius = 3, arch.thickness = 0.4, arch.half = std::numbers::pi / 3;
    arch.width = 1.2;
    const double road = arch.outer() + 0.15;
    const double end = arch.outer() * std::cos(arch.joint(0));
    for (int i = 0; i < 17; ++i)
        add_prism(s, arch.between(arch.joint(i), arch.joint(i + 1)), arch.width);
    for (int i = 0; i < 17; ++i) {
        const Outline stone = arch.between(arch.joint(i), arch.joint(i + 1));
        add_prism(s, {stone[2], stone[1], {stone[1].x(), road}, {stone[2].x(), road}}, arch.width);
    }
    for (int i = 0; i < 11; ++i)
        add_body(s, box(end / 11, 0.06, 0.6), {end / 11 * (2 * i + 1) - end, road + 0.06, 0});
    for (const double side : {-1.0, 1.0}) {
        add_body(s, box(2, 1, 0.6), {side * (end + 2), road + 0.12 - 1, 0}, Motion::fixed);
        const double springing = side < 0 ? arch.joint(17) : arch.joint(0) - 0.2;
        add_prism(s, Arch::between(springing, springing + 0.2, arch.inner() - 0.4, arch.outer()),
                  2 * arch.width)
            .motion = Motion::fixed;
    }
    return s;
}
void add_cart(Scene& s, double speed) {
    constexpr double kWheel = 0.15;
    const double axle = s.bodies[kBridge - 1].placement.position.y() + 0.06 + kWheel;
    const auto cart = static_cast<std::uint32_t>(s.bodies.size());
    add_body(s, box(0.4, 0.1, 0.25), {-4, axle + 0.05, 0}).velocity = {speed, 0, 0};
    for (const double x : {-0.3, 0.3})
        for (const double z : {-0.35, 0.35}) {
            const auto wheel = static_cast<std::uint32_t>(s.bodies.size());
            BodySpec& b = add_body(s, sphere(kWheel), {x - 4, axle, z});
            b.velocity = {speed, 0, 0}, b.angular_velocity = {0, 0, -speed / kWheel};
            add_joint(s, JointKind::hinge, cart, wheel, Vector(x - 4, axle, z)).frame =
                Rotation::FromTwoVectors(Vector::UnitX(), Vector::UnitZ());
        }
}

TEST_P(Stones, ABridgeStands) { expect_stands(bridge(scene()), collider(), 6, "bridge"); }

TEST_P(Stones, ACartRollsOverABridge) {
    Scene s = bridge(scene());
    s.settings.dt = s.settings.precision == Precision::single ? 0.01 : 1.0 / 60;
    const std::size_t first = s.bodies.size();
    add_cart(s, 1);
    Simulation simulation(s, colliders(), collider());
    const Bodies& b = simulation.world().bodies;
    const std::vector<Vector> start(b.position.begin(), b.position.begin() + first);
    double most = 0;
    while (simulation.time() < 10) {
        simulation.step();
        most = std::max(most, farthest_from(start, simulation.world()));
    }
    EXPECT_LT(most, kSag * 6);
    EXPECT_GT(b.position[first].x(), 3) << "it has crossed it";
}

/// A board of length L and thickness t leans at θ from the vertical against a smooth wall. It
/// touches the ground and the wall along edges of its face to the wall; moments about the lower one
/// give the friction that holds it, (tan θ − t/L)/2.
constexpr double kThickness = 0.05;
Scene leaning_board(const Scene& empty, double angle, double friction) {
    Scene s = with_friction(empty, friction);
    add_ground(s);
    s.materials.push_back(s.materials[0]);
    s.materials.back().name = "smooth", s.materials.back().friction = 0;
    add_body(s, box(0.5, 2, 1), {0.5, 2, 0}, Motion::fixed).material = 1;
    const Rotation turn(Eigen::AngleAxisd(-angle, Vector::UnitZ()));
    const Vector top = turn * Vector(kThickness / 2, 0.5, 0);
    const Vector foot = turn * Vector(kThickness / 2, -0.5, 0);
    add_body(s, box(kThickness / 2, 0.5, 0.15), {-top.x(), -foot.y(), 0}).placement.rotation = turn;
    return s;
}

TEST_P(Boards, LeanAsFarAsFrictionHoldsThem) {
    for (const double degrees : {12, 20, 35}) {
        const double angle = degrees * std::numbers::pi / 180;
        const double least = 0.5 * (std::tan(angle) - kThickness);
        const std::string name = std::to_string(degrees) + " degrees";
        expect_stands(leaning_board(scene(), angle, least / kShort), collider(), 1, name);
        expect_falls(leaning_board(scene(), angle, least / kBeyond), collider(), 1, name);
    }
}

/// Storeys of leaning boards with boards laid across their tops.
Scene house(const Scene& empty, int storeys, double length, double thickness, double angle) {
    Scene s = with_friction(empty, 0.6);
    add_ground(s);
    const double high = length * std::cos(angle) + thickness * std::sin(angle);
    const double wide = length * std::sin(angle) + thickness * std::cos(angle);
    double floor = 0;
    for (int storey = 0; storey < storeys; ++storey) {
        const int pairs = storeys - storey;
        for (int i = 0; i < pairs; ++i)
            for (const double side : {-1.0, 1.0}) {
                const double x = (2 * i - pairs + 1) * wide + side * wide / 2;
                add_body(s, box(thickness / 2, length / 2, 0.36 * length), {x, floor + high / 2, 0})
                    .placement.rotation = Eigen::AngleAxisd(side * angle, Vector::UnitZ());
            }
        floor += high;
        for (int i = 0; i + 1 < pairs; ++i)
            add_body(s, box(0.98 * wide, thickness / 2, 0.36 * length),
                     {(2 * i - pairs + 2) * wide, floor + thickness / 2, 0});
        floor += thickness;
    }
    return s;
}

TEST_P(Boards, HousesOfPlanksAndCardsStand) {
    const double angle = 20 * std::numbers::pi / 180;
    expect_stands(house(scene(), 4, 1, 0.08, angle), collider(), 1, "planks");
    expect_stands(house(scene(), 3, 0.088, 0.003, angle), collider(), 0.088, "cards");
}

/// The k-th brick from the top reaches 1/2k of its length beyond the one below, at the most.
TEST_P(Boards, ACorbelReachesAsFarAsItBalances) {
    for (const int bricks : {4, 8, 15})
        for (const double share : {0.95, 1.05}) {
            Scene s = with_friction(scene(), 0.7);
            add_ground(s);
            double x = 0;
            for (int i = 0; i < bricks; ++i) {
                if (i > 0) x += share / (2 * (bricks - i));
                add_body(s, box(0.5, 0.1, 0.2), {x, 0.1 * (2 * i + 1), 0});
            }
            const std::string name = std::to_string(bricks) + " bricks";
            if (share < 1)
                expect_stands(s, collider(), 1, name);
            else
                expect_falls(s, collider(), 1, name);
        }
}

/// 810 bricks: sweeps alone let it fall.
TEST_P(Boards, AWallBeyondExactIslandsStands) {
    Scene s = with_friction(scene(), 0.6);
    add_ground(s);
    add_structure(s, wall(40, 20, {0.1, 0.05, 0.05}, 0));
    s.settings.dt = s.settings.precision == Precision::single ? 0.01 : 1.0 / 60;
    const double seconds = kSeconds / 4, size = 8;
    EXPECT_LT(farthest_after(s, collider(), seconds), kSag * size);
    s.settings.accuracy = 0;
    EXPECT_GT(farthest_after(s, collider(), seconds), 0.01 * size);
}

/// 10,040 bricks, in 80 courses.
TEST_P(Boards, AWallOfTenThousandBricksStands) {
    Scene s = with_friction(scene(), 0.6);
    add_ground(s);
    add_structure(s, wall(125, 80, {0.25, 0.125, 0.125}, 0.005));
    s.settings.dt = s.settings.precision == Precision::single ? 0.01 : 1.0 / 60;
    EXPECT_LT(farthest_after(s, collider(), kSeconds / 12), kSag * 20);
}

}  // namespace
}  // namespace plumb::test
