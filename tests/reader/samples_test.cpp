// SPDX-License-Identifier: MIT
#include <filesystem>
#include <set>

#include "reading.h"
#include "scene/deformable_faults.h"
#include "scene/link_faults.h"

namespace plumb::test {

namespace {

Scene sample(const std::string& name) {
    return read_scene(PLUMB_SAMPLES "/scenes/" + name + ".json");
}

}  // namespace

TEST(Samples, AllAreRead) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(PLUMB_SAMPLES "/scenes")) {
        if (entry.path().extension() != ".json") continue;
        const Scene scene = read_scene(entry.path());
        EXPECT_EQ(scene.name, entry.path().stem()) << entry.path();
        EXPECT_FALSE(scene.description.empty()) << entry.path();
        EXPECT_TRUE(scene.view.has_value()) << entry.path();
        ++count;
    }
    EXPECT_GE(count, 9);
}

TEST(Samples, PileHasTwoThousandBodiesAmongNinePoles) {
    const Scene scene = sample("pile");
    std::size_t boxes = 0, balls = 0, fixed = 0;
    std::set<std::string> names;
    for (const BodySpec& body : scene.bodies) {
        names.insert(body.name);
        if (body.motion == Motion::fixed) {
            ++fixed;
        } else if (scene.geometries[body.geometry].kind == ShapeKind::box) {
            ++boxes;
        } else {
            ++balls;
        }
    }
    EXPECT_EQ(boxes, 1000u);
    EXPECT_EQ(balls, 1000u);
    EXPECT_EQ(fixed, 10u);
    EXPECT_EQ(names.size(), 2010u);

    // The second layer begins with the 197th of them, one spacing higher.
    const Eigen::Vector3d wanted(-6.5 * 0.75, 5.25, -6.5 * 0.75);
    EXPECT_LE((scene.bodies[10 + 196].placement.position - wanted).cwiseAbs().maxCoeff(), 0.02);
}

TEST(Samples, StackStandsOnTheGroundWithoutGaps) {
    for (const std::string name : {"stack", "stack_heavy"}) {
        const Scene scene = sample(name);
        ASSERT_EQ(scene.bodies.size(), 21u);
        for (std::size_t i = 1; i <= 20; ++i) {
            EXPECT_EQ(scene.bodies[i].placement.position.y(), static_cast<double>(i) - 0.5);
        }
        EXPECT_EQ(scene.settings.require, (std::vector<std::string>{"shock_propagation"}));
    }
    const Scene heavy = sample("stack_heavy");
    const auto density = [&](std::size_t i) {
        return heavy.materials[heavy.bodies[i].material].density;
    };
    EXPECT_EQ(density(20), 1000 * density(19));
}

TEST(Samples, BoxesLieOnTheSlope) {
    const Scene scene = sample("slope");
    const Eigen::Vector3d normal = scene.bodies[0].placement.rotation * Eigen::Vector3d::UnitY();
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        EXPECT_NEAR(normal.dot(scene.bodies[i].placement.position), 0.25, 1e-5)
            << scene.bodies[i].name;
    }
    EXPECT_EQ(scene.material_pairs.size(), 7u);
}

TEST(Samples, PendulumsJointsAreWhereTheLinksMeet) {
    const Scene scene = sample("pendulum");
    ASSERT_EQ(scene.joints.size(), 10u);
    const auto& shape = scene.geometries[0];
    for (const JointSpec& joint : scene.joints) {
        for (const std::uint32_t body : {joint.body_a, joint.body_b}) {
            if (body == kNoIndex) continue;
            const double distance = (scene.bodies[body].placement.position - joint.anchor).norm();
            EXPECT_NEAR(distance, shape.half_extents.x(), 1e-12) << joint.name;
        }
    }
}

TEST(Samples, LinkagesPinsAreOnTheirLinks) {
    const Scene scene = sample("linkage");
    ASSERT_EQ(scene.joints.size(), 8u);
    for (const JointSpec& joint : scene.joints) {
        for (const std::uint32_t index : {joint.body_a, joint.body_b}) {
            if (index == kNoIndex) continue;
            const BodySpec& body = scene.bodies[index];
            if (body.name == "piston") continue;
            // At an end of the link or, of the coupler, in its middle.
            const Eigen::Vector3d pin =
                body.placement.rotation.conjugate() * (joint.anchor - body.placement.position);
            const double half = scene.geometries[body.geometry].half_extents.x();
            const bool middle = joint.name == "coupler_middle" && body.name == "coupler";
            EXPECT_NEAR(std::abs(pin.x()), middle ? 0 : half, 1e-12) << joint.name << body.name;
            EXPECT_NEAR(pin.y(), 0, 1e-12) << joint.name << body.name;
        }
    }
}

TEST(Samples, GearsRollOnEachOther) {
    const Scene scene = sample("gears");
    ASSERT_EQ(scene.couplings.size(), 3u);
    const double radius[] = {0.6, 0.3, 0.45};
    for (std::size_t i = 0; i < 2; ++i) {
        const double apart = (scene.joints[i + 1].anchor - scene.joints[i].anchor).norm();
        EXPECT_NEAR(apart, radius[i] + radius[i + 1], 1e-15);
        EXPECT_NEAR(scene.couplings[i].ratio, -radius[i] / radius[i + 1], 1e-15);
    }
    EXPECT_EQ(scene.couplings[2].ratio, radius[2]);
}

TEST(Samples, CarsSpringsCarryIt) {
    const Scene scene = sample("car");
    double force = 0;
    for (const JointSpec& joint : scene.joints) {
        const JointAxisSpec& axis = joint.axes[kAlongX];
        force -= axis.stiffness * axis.rest;
    }
    double weight = 0;
    for (const BodySpec& body : scene.bodies)
        if (body.name == "chassis") weight = *body.mass * 9.81;
    EXPECT_NEAR(force, weight, 0.02 * weight);
}

TEST(Samples, RagdollsLimbsMeetAtItsJoints) {
    const Scene scene = sample("ragdoll");
    ASSERT_EQ(scene.joints.size(), 10u);
    for (const JointSpec& joint : scene.joints) {
        for (const std::uint32_t index : {joint.body_a, joint.body_b}) {
            const BodySpec& body = scene.bodies[index];
            const Geometry& shape = scene.geometries[body.geometry];
            const Eigen::Vector3d local =
                body.placement.rotation.conjugate() * (joint.anchor - body.placement.position);
            // Within 1 cm of a limb's end, or 3 cm of the trunk.
            if (shape.kind == ShapeKind::capsule) {
                EXPECT_NEAR(std::abs(local.y()), shape.half_height + shape.radius, 0.01)
                    << joint.name << " " << body.name;
            } else {
                const Eigen::Vector3d half = shape.kind == ShapeKind::box
                                                 ? shape.half_extents
                                                 : Eigen::Vector3d::Constant(shape.radius);
                EXPECT_TRUE(((local.cwiseAbs() - half).array() <= 0.031).all())
                    << joint.name << " " << body.name;
            }
        }
    }
}

TEST(Samples, ConveyorsScriptBeginsWhereThePlatformIs) {
    const Scene scene = sample("conveyor");
    const BodySpec& platform = scene.bodies[1];
    ASSERT_FALSE(platform.script.keyframes.empty());
    EXPECT_EQ(platform.script.keyframes.front().placement.position, platform.placement.position);
    EXPECT_EQ(platform.script.keyframes.back().placement.position, platform.placement.position);
    EXPECT_TRUE(platform.script.loop);
}

TEST(Samples, ClothHangsByFourEqualCornersUnderTenTori) {
    const Scene scene = sample("cloth");
    ASSERT_EQ(scene.deformables.size(), 1u);
    EXPECT_EQ(scene.deformables[0].points.size(), 41u * 41u);
    ASSERT_EQ(scene.attachments.size(), 4u);
    for (const AttachmentSpec& corner : scene.attachments) {
        EXPECT_EQ(corner.body, kNoIndex);
        EXPECT_EQ(corner.points.size(), 6u);
    }
    std::size_t rings = 0;
    for (const BodySpec& body : scene.bodies) rings += body.motion == Motion::dynamic;
    EXPECT_EQ(rings, 10u);
}

TEST(Samples, TrampolinesEdgeIsInItsFrame) {
    const Scene scene = sample("trampoline");
    std::set<std::uint32_t> held;
    for (const AttachmentSpec& side : scene.attachments)
        held.insert(side.points.begin(), side.points.end());
    EXPECT_EQ(held.size(), 4u * 24u);
}

TEST(Samples, StringsEndsAreAtTheCeilingAndOnTheCrate) {
    const Scene scene = sample("string");
    ASSERT_EQ(scene.attachments.size(), 2u);
    for (const AttachmentSpec& end : scene.attachments) {
        const BodySpec& body = scene.bodies[end.body];
        const Eigen::Vector3d local =
            scene.deformables[0].points[end.points[0]] - body.placement.position;
        EXPECT_NEAR(std::abs(local.y()), scene.geometries[body.geometry].half_extents.y(), 1e-12);
    }
}

TEST(Samples, BalloonsTopsAreOnThePlank) {
    const Scene scene = sample("balloons");
    ASSERT_EQ(scene.attachments.size(), 6u);
    for (const AttachmentSpec& top : scene.attachments) {
        EXPECT_EQ(scene.bodies[top.body].name, "plank");
        EXPECT_GE(top.points.size(), 3u);
        const double plank = scene.bodies[top.body].placement.position.y() - 0.025;
        for (const std::uint32_t p : top.points)
            EXPECT_NEAR(scene.deformables[top.deformable].points[p].y(), plank, 0.02);
    }
}

TEST(Samples, NetsRopesAreSlackAtTheStart) {
    const Scene scene = sample("net");
    ASSERT_EQ(scene.links.size(), 4u);
    for (const LinkSpec& rope : scene.links) {
        EXPECT_FALSE(rope.shortest);
        EXPECT_LT((position_of(scene, rope.a) - position_of(scene, rope.b)).norm(), *rope.longest);
        EXPECT_EQ(std::abs(position_of(scene, rope.a).x()), 0.8);
    }
}

TEST(Samples, DuckIsClosedAndStandsOnTheGround) {
    const Scene scene = sample("elk");
    EXPECT_TRUE(scene.remarks.empty());
    const DeformableSpec& duck = scene.deformables.at(0);
    EXPECT_GT(duck.points.size(), 500u);
    EXPECT_FALSE(deformable_faults::edge_fault(duck.triangles, true));
    EXPECT_NEAR(deformable_faults::enclosed_volume(duck.points, duck.triangles), 0.18, 0.005);
    double lowest = 1;
    for (const Eigen::Vector3d& p : duck.points) lowest = std::min(lowest, p.y());
    EXPECT_GE(lowest, duck.radius);
    EXPECT_LE(lowest, duck.radius + 0.02);
}

TEST(Samples, ElksWheelsRollOnTheGround) {
    const Scene scene = sample("elk");
    ASSERT_EQ(scene.joints.size(), 4u);
    for (const JointSpec& axle : scene.joints) {
        const BodySpec& wheel = scene.bodies[axle.body_a];
        const double radius = scene.geometries[wheel.geometry].radius;
        EXPECT_EQ(axle.anchor, wheel.placement.position);
        EXPECT_EQ(wheel.placement.position.y(), radius);
        EXPECT_DOUBLE_EQ(wheel.velocity.x(), -wheel.angular_velocity.z() * radius);
    }
}

}  // namespace plumb::test
