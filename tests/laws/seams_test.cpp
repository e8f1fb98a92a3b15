// SPDX-License-Identifier: MIT
/// Slabs that lie flush carry what rolls, slides and tumbles over them as one slab does: edges that
/// nothing can reach take no speed. An edge that stands out stops what runs against it.
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"

namespace plumb::test {
namespace {

enum class Slabs { one, rows, tiles, bricks };

/// A pavement of slabs `length` long under [−2, far] × [−wide, wide], its top at height 0.
struct Pavement {
    Slabs slabs = Slabs::rows;
    double length = 1, far = 10, wide = 2;
    bool of_hulls = false;
    bool loose = false;  ///< they lie on a bed and can move
    double uneven = 0;   ///< greatest step between two [m]
};

constexpr double kThickness = 0.2;

Geometry slab(double length, double width, bool as_hull) {
    Geometry g = box(length / 2, kThickness / 2, width / 2);
    if (!as_hull) return g;
    Geometry h;
    h.kind = ShapeKind::hull;
    for (int corner = 0; corner < 8; ++corner)
        h.vertices.emplace_back((corner & 1 ? 1 : -1) * g.half_extents.x(),
                                (corner & 2 ? 1 : -1) * g.half_extents.y(),
                                (corner & 4 ? 1 : -1) * g.half_extents.z());
    h.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return h;
}

void pave(Scene& s, const Pavement& p, Random& random) {
    const auto lay = [&](double x, double z, double length, double width) {
        const double up = p.uneven * random.number(-0.5, 0.5);
        BodySpec& body = add_body(s, slab(length, width, p.of_hulls), {x, up - kThickness / 2, z});
        if (!p.loose) body.motion = Motion::fixed;
    };
    if (p.slabs == Slabs::one) return lay((p.far - 2) / 2, 0, p.far + 2, 2 * p.wide);
    if (p.loose) {
        BodySpec& bed = add_body(s, box(p.far + 4, 0.5, p.wide + 1), {0, -kThickness - 0.5, 0});
        bed.motion = Motion::fixed;
    }
    const int rows = static_cast<int>(std::ceil((p.far + 2) / p.length));
    for (int i = 0; i <= rows; ++i) {
        const double x = -2 + (i + 0.5) * p.length;
        if (p.slabs == Slabs::rows) {
            lay(x, 0, p.length, 2 * p.wide);
            continue;
        }
        const int half = static_cast<int>(std::ceil(p.wide / p.length));
        for (int k = -half; k <= half; ++k) {
            const bool shifted = p.slabs == Slabs::bricks && k % 2 != 0;
            lay(x + (shifted ? p.length / 2 : 0), k * p.length, p.length, p.length);
        }
    }
}

Pavement draw_pavement(Random& random, double size, bool hulls) {
    Pavement p;
    p.slabs = std::vector{Slabs::rows, Slabs::tiles, Slabs::bricks}[random.below(3)];
    p.length = size * random.number(2.5, 8);
    p.far = 14 * size, p.wide = 3 * size;
    p.of_hulls = hulls && random.below(3) == 0;
    p.loose = random.below(3) == 0;
    p.uneven = random.below(2) * 2e-6 * size;
    return p;
}

/// What moves over a pavement along x, with its lowest points at height 0.
struct Mover {
    std::string name;
    Geometry geometry;
    double height;  ///< of its centre [m]
    Rotation rotation;
    double rolls_at = 0;  ///< radius [m]; 0: it slides
};

Rotation lying() { return Rotation(Eigen::AngleAxisd(std::numbers::pi / 2, Vector::UnitX())); }

bool has_all_shapes(const std::string& collider) { return collider != "reference"; }

std::vector<Mover> movers(const std::string& collider, double r, Random& random) {
    const Rotation turned(Eigen::AngleAxisd(random.number(0, 3), Vector::UnitY()));
    const Rotation along(Eigen::AngleAxisd(std::numbers::pi / 2, Vector::UnitZ()));
    std::vector<Mover> all = {{"ball", sphere(r), r, Rotation::Identity(), r},
                              {"capsule", capsule(r, 1.5 * r), r, lying(), r},
                              {"cube", box(r, r, r), r, Rotation::Identity()},
                              {"turned box", box(1.5 * r, r, 0.7 * r), r, turned},
                              {"capsule on its side", capsule(r, 1.5 * r), r, along}};
    if (!has_all_shapes(collider)) return all;
    all.push_back({"cylinder", cylinder(r, 1.5 * r), r, lying(), r});
    all.push_back({"cylinder on its end", cylinder(r, r), r, Rotation::Identity()});
    return all;
}

class Seams : public OnEveryCollider {
protected:
    /// The most that a law may miss, as a share of what it is about.
    static constexpr double kSlack = 1e-3;
};

TEST_P(Seams, TakeNoSpeedFromWhatRollsOrSlidesOverThem) {
    for (unsigned draw = 0; draw < 4; ++draw) {
        Random random(draw);
        const double r = random.number(0.05, 0.3);
        const double v = std::pow(10, random.number(-0.5, 0.8));
        for (const Mover& mover : movers(collider(), r, random)) {
            Scene s = scene();
            draw_settings(s.settings, random, static_cast<int>(draw));
            const Pavement p = draw_pavement(random, r, has_all_shapes(collider()));
            pave(s, p, random);
            BodySpec& body = add_body(s, mover.geometry, {0, mover.height + 1e-6 * r, 0});
            body.placement.rotation = mover.rotation;
            body.velocity = {v, 0, 0};
            if (mover.rolls_at > 0) body.angular_velocity = {0, 0, -v / mover.rolls_at};
            s.materials[0].friction = mover.rolls_at > 0 ? 0.5 : 0;
            const auto id = static_cast<std::uint32_t>(s.bodies.size() - 1);
            Simulation simulation(s, colliders(), collider());
            run_for(simulation, 11 * r / v);
            const Bodies& b = simulation.world().bodies;
            EXPECT_NEAR(b.velocity[id].x() / v, 1, kSlack) << mover.name << ", draw " << draw;
            EXPECT_NEAR(b.position[id].y(), mover.height, 2e-3 * r) << mover.name << " " << draw;
        }
    }
}

/// Deepest corner of a box under height 0, from now on for `seconds`, over the pavement [m].
double deepest_corner(Simulation& simulation, std::uint32_t body, const Vector& half,
                      const Pavement& p, double seconds) {
    double deepest = 0;
    const Bodies& b = simulation.world().bodies;
    while (simulation.time() < seconds) {
        simulation.step();
        for (int corner = 0; corner < 8; ++corner) {
            const Vector own((corner & 1 ? 1 : -1) * half.x(), (corner & 2 ? 1 : -1) * half.y(),
                             (corner & 4 ? 1 : -1) * half.z());
            const Vector at = in_world(b, body, own);
            if (at.x() > -2 && at.x() < p.far && std::abs(at.z()) < p.wide)
                deepest = std::max(deepest, -at.y());
        }
    }
    return deepest;
}

TEST_P(Seams, AreLandedOnAsOneSlabIs) {
    constexpr int kDraws = 12;
    double on_slabs = 0, on_one = 0;
    for (unsigned draw = 0; draw < kDraws; ++draw)
        for (const bool one : {true, false}) {
            Random random(draw);
            Scene s = scene();
            draw_settings(s.settings, random, static_cast<int>(draw));
            Pavement p = draw_pavement(random, 0.1, false);
            p.loose = false, p.uneven = 0, p.far = 4, p.wide = 2;
            if (one) p.slabs = Slabs::one;
            const Vector half(random.number(0.05, 0.15), random.number(0.05, 0.15), 0.1);
            pave(s, p, random);
            Random thrown(draw);
            BodySpec& body = add_body(s, box(half), {1, 0.3, 0});
            body.placement.rotation = thrown.rotation();
            body.velocity = 1.5 * thrown.vector();
            body.angular_velocity = 6 * thrown.vector();
            const auto id = static_cast<std::uint32_t>(s.bodies.size() - 1);
            Simulation simulation(s, colliders(), collider());
            (one ? on_one : on_slabs) += deepest_corner(simulation, id, half, p, 1.5) / kDraws;
        }
    EXPECT_LT(on_slabs, 2 * on_one + 2e-4);
    EXPECT_LT(on_slabs, 2e-3);
}

TEST_P(Seams, ThatStandOutStopWhatSlidesAgainstThem) {
    for (unsigned draw = 0; draw < 6; ++draw) {
        Random random(draw);
        Scene s = scene();
        draw_settings(s.settings, random, static_cast<int>(draw));
        const double r = random.number(0.05, 0.3), step = r * random.number(0.02, 0.5);
        add_body(s, box(1, 0.2, 1), {0, -0.2, 0}, Motion::fixed);
        add_body(s, box(1, 0.2, 1), {2, -0.2 + step, 0}, Motion::fixed);
        add_body(s, box(r, r, r), {1 - 3 * r, r, 0}).velocity = {0.5, 0, 0};
        s.materials[0].friction = 0.02;
        Simulation simulation(s, colliders(), collider());
        double farthest = 0;
        while (simulation.time() < 4 * r + 1) {
            simulation.step();
            farthest = std::max(farthest, simulation.world().bodies.position[2].x());
        }
        EXPECT_NEAR(farthest, 1 - r, 0.05 * r) << draw;
        EXPECT_LT(simulation.world().bodies.velocity[2].norm(), 0.1) << draw;
    }
}

/// A plate with a stem beneath, which hangs between two rails that it lies on.
TEST_P(Seams, AreNoneToWhatHangsBelowThem) {
    Geometry tee;
    tee.kind = ShapeKind::compound;
    tee.parts.resize(2);
    tee.parts[0].geometry = box(0.6, 0.05, 0.3);
    tee.parts[1].geometry = box(0.2, 0.2, 0.3);
    tee.parts[1].local.position = {0, -0.25, 0};
    for (unsigned draw = 0; draw < 3; ++draw) {
        Random random(draw);
        Scene s = scene();
        draw_settings(s.settings, random, static_cast<int>(draw));
        for (const int side : {-1, 1})
            add_body(s, box(0.2, 0.5, 5), {0.45 * side, -0.5, 0}, Motion::fixed);
        add_body(s, tee, {0, 0.05, 0}).velocity = {1, 0, 0};
        s.materials[0].friction = 0;
        const double before = s.bodies[2].placement.position.x();
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 1);
        EXPECT_LT(simulation.world().bodies.position[2].x() - before, 0.06) << draw;
    }
}

INSTANTIATE_TEST_SUITE_P(Everywhere, Seams, every_collider(), where_name);

}  // namespace
}  // namespace plumb::test
