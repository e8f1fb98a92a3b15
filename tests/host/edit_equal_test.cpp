// SPDX-License-Identifier: MIT
/// An edited world is the world that would have been made so: bit for bit, on every collider.
#include "host/editing.h"

namespace plumb::test {
namespace {

class EditedWorlds : public testing::TestWithParam<std::string> {
protected:
    Simulation running(const Scene& scene) const { return {scene, colliders(), GetParam()}; }
};

TEST_P(EditedWorlds, ABodyAddedAtTheStartIsOneOfTheScene) {
    Scene whole = heap();
    Scene less = whole;
    less.bodies.pop_back();
    Simulation built = running(whole), edited = running(less);
    EXPECT_EQ(edited.add_body(whole.bodies.back()), whole.bodies.size() - 1);
    for (int i = 0; i < 80; ++i) {
        built.step(), edited.step();
        ASSERT_EQ(hash_of(edited), hash_of(built)) << "step " << i;
    }
}

TEST_P(EditedWorlds, AnEmptySceneMayBeFilledPieceByPiece) {
    Scene whole = heap();
    add_machine(whole);
    whole.materials.push_back({"rubber", 900, 0.9, 0.4, 0, 0});
    whole.bodies[5].material = 1;
    whole.couplings.push_back({"", 1, 3, kTurnX, kTurnX, 0.5, {}});
    whole.settings.substeps = 2;
    Scene empty;
    empty.settings = whole.settings;
    Simulation built = running(whole), edited = running(empty);
    for (const Geometry& g : whole.geometries) edited.add_geometry(g);
    edited.add_material(whole.materials[1]);
    for (const BodySpec& body : whole.bodies) edited.add_body(body);
    for (const JointSpec& joint : whole.joints) edited.add_joint(joint);
    for (const CouplingSpec& coupling : whole.couplings) edited.add_coupling(coupling);
    for (std::size_t i = 0; i < kEffectCount; ++i) {
        EXPECT_EQ(edited.plan().decisions[i].runs, built.plan().decisions[i].runs);
        EXPECT_EQ(edited.plan().decisions[i].why, built.plan().decisions[i].why);
    }
    for (int i = 0; i < 80; ++i) {
        built.step(), edited.step();
        ASSERT_EQ(hash_of(edited), hash_of(built)) << "step " << i;
    }
}

/// A body far from the heap, on the ground, comes and goes.
TEST_P(EditedWorlds, WhatComesAndGoesFarAwayIsNotFelt) {
    Scene scene = heap();
    add_machine(scene);
    Simulation quiet = running(scene), edited = running(scene);
    const auto bodies = static_cast<std::uint32_t>(scene.bodies.size());
    std::uint32_t guest = 0, anchor = 0;
    for (int i = 0; i < 100; ++i) {
        if (i == 20) guest = edited.add_body(body_of(1, {50, 0.21, 50}));
        if (i == 40) {
            JointSpec joint;
            joint.body_a = guest;
            joint.anchor = {50, 1, 50};
            anchor = edited.add_joint(joint);
        }
        if (i == 60) edited.remove_joint(anchor);
        if (i == 80) edited.remove_body(guest);
        quiet.step(), edited.step();
        for (std::uint32_t b = 0; b < bodies; ++b)
            ASSERT_TRUE(same_state(edited, b, quiet, b)) << "step " << i << ", body " << b;
    }
    EXPECT_EQ(hash_of(edited), hash_of(quiet));
    EXPECT_EQ(edited.world().bodies.size(), bodies);
}

/// The heap does not notice that a body which stands before it in the tables goes, and another
/// comes in its place.
TEST_P(EditedWorlds, APlaceInTheMiddleMayFallVacant) {
    const Scene lone = heap();
    Scene scene = lone;
    scene.bodies.insert(scene.bodies.begin() + 1, body_of(1, {50, 0.21, 50}));
    Simulation quiet = running(lone), edited = running(scene);
    for (int i = 0; i < 100; ++i) {
        if (i == 30) edited.remove_body(1);
        if (i == 60) {
            EXPECT_EQ(edited.slot_of(edited.add_body(body_of(2, {-50, 0.2, 50}))), 1u);
        }
        quiet.step(), edited.step();
        for (std::uint32_t b = 1; b < lone.bodies.size(); ++b)
            ASSERT_TRUE(same_state(edited, b + 1, quiet, b)) << "step " << i << ", body " << b;
        if (i == 50) {
            EXPECT_EQ(hash_of(edited), hash_of(quiet)) << "vacant slots do not count";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, EditedWorlds, testing::Values("reference", "ode", "bullet", "fcl"),
                         [](const auto& param_info) { return param_info.param; });

/// A joint of this kind, driven where the kind leaves room.
JointSpec joint_of(JointKind kind) {
    JointSpec joint;
    joint.kind = kind;
    joint.body_a = 1, joint.body_b = 2;
    joint.anchor = {0.1, 2.05, 0};
    joint.frame = Rotation(Eigen::AngleAxisd(0.4, Vector(1, 2, 3).normalized()));
    if (kind == JointKind::distance) joint.anchor_b = Vector(0.6, 2.2, 0.1);
    if (kind == JointKind::six_axis) joint.locked = {true, false, true, false, true, false};
    JointMotor motor;
    motor.mode = MotorMode::velocity;
    motor.target = 0.7, motor.greatest = 40;
    switch (kind) {
        case JointKind::hinge:
        case JointKind::cylindrical:
            joint.axes[kTurnX].motor = motor;
            break;
        case JointKind::slider:
            joint.axes[kAlongX].motor = motor;
            joint.axes[kAlongX].upper = 0.05;
            break;
        case JointKind::cone_twist:
            joint.axes[kTurnY].upper = 0.5;
            break;
        case JointKind::six_axis:
            joint.axes[kTurnX].stiffness = 20;
            joint.axes[kTurnX].damping = 1;
            break;
        default:
            break;
    }
    return joint;
}

TEST(EditedJoints, OfEveryKindAddedAtTheStartAreThoseOfTheScene) {
    for (std::uint32_t kind = 0; kind <= static_cast<std::uint32_t>(JointKind::six_axis); ++kind)
        for (const JointMethod method : {JointMethod::tree, JointMethod::iterate}) {
            Scene bare;
            bare.settings.joints = method;
            add_ground(bare);
            add_body(bare, box(0.2, 0.1, 0.15), {0, 2, 0}).angular_velocity = {1, 2, 3};
            add_body(bare, box(0.1, 0.3, 0.15), {0.5, 2.1, 0}).velocity = {-1, 0, 0.5};
            Scene jointed = bare;
            jointed.joints.push_back(joint_of(static_cast<JointKind>(kind)));
            Simulation built(jointed, colliders(), "reference");
            Simulation edited(bare, colliders(), "reference");
            EXPECT_EQ(edited.add_joint(jointed.joints[0]), 0u);
            for (int i = 0; i < 100; ++i) {
                built.step(), edited.step();
                ASSERT_EQ(hash_of(edited), hash_of(built)) << "kind " << kind << ", step " << i;
            }
        }
}

/// The stepper made anew in the middle of a run is as good as the old one.
TEST(EditedWorldsState, ARenewalIsNotFelt) {
    for (const JointMethod method : {JointMethod::tree, JointMethod::iterate})
        for (const std::uint32_t threads : {1u, 2u})
            for (const std::uint32_t substeps : {1u, 3u})
                for (const char* required : {"", "shock_propagation"}) {
                    Settings settings;
                    settings.joints = method;
                    settings.threads = threads, settings.substeps = substeps;
                    if (*required) settings.require = {required};
                    Scene scene = heap(settings);
                    add_machine(scene);
                    scene.materials[0].restitution = 0.3;
                    Simulation quiet(scene, colliders(), "ode"), edited(scene, colliders(), "ode");
                    for (int i = 0; i < 60; ++i) {
                        edited.add_material({});  // nobody is of it
                        quiet.step(), edited.step();
                        ASSERT_EQ(hash_of(edited), hash_of(quiet)) << "step " << i;
                    }
                }
}

}  // namespace
}  // namespace plumb::test
