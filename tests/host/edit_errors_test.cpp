// SPDX-License-Identifier: MIT
/// Edits that cannot be made: an exception with a sentence, and a world that goes on as if nobody
/// had tried.
#include "host/editing.h"
#include "host/source_proximity.h"

#include "scene/error.h"

#include <functional>
#include <limits>

namespace plumb::test {
namespace {

const Vector kNone = Vector::Zero();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Tries an edit that must fail on a heap under way, and compares what follows with a heap on which
/// nothing was tried.
template <class Error>
void expect_no_trace(const std::function<void(Simulation&)>& edit, const std::string& words) {
    Scene scene = heap();
    add_machine(scene);
    Simulation quiet(scene, colliders(), "reference"), edited(scene, colliders(), "reference");
    for (int i = 0; i < 30; ++i) quiet.step(), edited.step();
    quiet.remove_body(7), edited.remove_body(7);
    expect_refusal<Error>([&] { edit(edited); }, words);
    EXPECT_EQ(edited.world().bodies.size(), quiet.world().bodies.size());
    EXPECT_EQ(edited.world().joints.size(), quiet.world().joints.size());
    for (int i = 0; i < 20; ++i) quiet.step(), edited.step();
    EXPECT_EQ(hash_of(edited), hash_of(quiet));
    EXPECT_EQ(edited.add_body(body_of(1, {9, 9, 9})), quiet.add_body(body_of(1, {9, 9, 9})));
    JointSpec joint;
    joint.body_a = 5;
    EXPECT_EQ(edited.add_joint(joint), quiet.add_joint(joint));
}

void expect_bad_body(const std::function<void(BodySpec&)>& spoil, const std::string& words) {
    expect_no_trace<SceneError>(
        [&](Simulation& s) {
            BodySpec body = body_of(1, {0, 9, 0});
            spoil(body);
            s.add_body(body);
        },
        words);
}

TEST(BadEdits, OfBodies) {
    expect_bad_body([](BodySpec& b) { b.mass = 0; }, "positive number");
    expect_bad_body([](BodySpec& b) { b.mass = kInfinite; }, "positive number");
    expect_bad_body([](BodySpec& b) { b.inertia = Vector(1, 1, 9); }, "principal moments");
    expect_bad_body([](BodySpec& b) { b.geometry = 99; }, "no such shape");
    expect_bad_body([](BodySpec& b) { b.geometry = 0; }, "encloses no volume");
    expect_bad_body([](BodySpec& b) { b.geometry = kNoIndex; }, "without a shape");
    expect_bad_body([](BodySpec& b) { b.material = 3; }, "no such material");
    expect_bad_body([](BodySpec& b) { b.placement.position.x() = kInfinite; }, "finite");
    expect_bad_body([](BodySpec& b) { b.placement.rotation.coeffs().setZero(); }, "rotation");
    expect_bad_body([](BodySpec& b) { b.velocity.setConstant(std::nan("")); }, "finite");
}

void expect_bad_joint(const std::function<void(JointSpec&)>& spoil, const std::string& words) {
    expect_no_trace<SceneError>(
        [&](Simulation& s) {
            JointSpec joint;
            joint.kind = JointKind::hinge;
            joint.body_a = 1, joint.body_b = 2;
            spoil(joint);
            s.add_joint(joint);
        },
        words);
}

TEST(BadEdits, OfJoints) {
    expect_bad_joint([](JointSpec& j) { j.body_b = 1; }, "two different bodies");
    expect_bad_joint([](JointSpec& j) { j.body_a = 0, j.body_b = kNoIndex; }, "dynamic");
    expect_bad_joint([](JointSpec& j) { j.anchor.x() = kInfinite; }, "finite");
    expect_bad_joint([](JointSpec& j) { j.frame.coeffs() *= 2; }, "unit quaternion");
    expect_bad_joint([](JointSpec& j) { j.axes[kAlongX].friction = 1; }, "locked");
    expect_bad_joint([](JointSpec& j) { j.axes[kTurnX].lower = 1, j.axes[kTurnX].upper = 0; },
                     "lower limit");
    expect_bad_joint([](JointSpec& j) { j.kind = JointKind::distance; }, "two anchors");
    expect_bad_joint([](JointSpec& j) { j.breaking_force = 0; }, "above 0");
    expect_bad_joint([](JointSpec& j) { j.anchor.x() = 1e6; }, "too far from the centre of mass");
    expect_bad_joint([](JointSpec& j) { j.kind = JointKind(99); }, "no such kind");
    expect_bad_joint([](JointSpec& j) { j.axes[kTurnX].lower = kNan; }, "turn_x/limits: ");
    expect_bad_joint([](JointSpec& j) { j.axes[kTurnX].friction = kNan; }, "turn_x/friction: ");
    expect_bad_joint([](JointSpec& j) { j.axes[kTurnX].stiffness = -1; }, "spring/stiffness: ");
    expect_bad_joint(
        [](JointSpec& j) {
            j.kind = JointKind::cone_twist;
            j.axes[kTurnY].lower = -1, j.axes[kTurnY].upper = 1;
        },
        "swing/limits: a swing begins at 0");
    expect_bad_joint(
        [](JointSpec& j) {
            j.axes[kTurnX].motor.mode = MotorMode::velocity;
            j.axes[kTurnX].motor.keys = {{0, 1}, {2, 3}, {2, 4}};
        },
        "motor/velocity/2/0: must be later");
}

TEST(BadEdits, OfCouplings) {
    const auto bad = [](const std::function<void(CouplingSpec&)>& spoil, const std::string& words) {
        expect_no_trace<SceneError>(
            [&](Simulation& s) {
                CouplingSpec coupling;
                coupling.joint_a = 3, coupling.joint_b = 1;
                spoil(coupling);
                s.add_coupling(coupling);
            },
            words);
    };
    bad([](CouplingSpec& c) { c.axis_a = kAlongX; }, "leave free");
    bad([](CouplingSpec& c) { c.axis_b = 6; }, "two joints of the scene");
    bad([](CouplingSpec& c) { c.joint_b = 3; }, "cannot be coupled to itself");
    bad([](CouplingSpec& c) { c.ratio = 0; }, "other than 0");
    bad([](CouplingSpec& c) { c.ratio = kNan; }, "ratio: must be a finite");
    bad([](CouplingSpec& c) { c.offset = kNan; }, "offset: must be a finite");
    bad([](CouplingSpec& c) { c.offset = kInfinite; }, "offset: must be a finite");
}

TEST(BadEdits, OfWhatThereIsNot) {
    const auto unknown = [](auto edit, const std::string& words) {
        expect_no_trace<std::out_of_range>(edit, words);
    };
    unknown([](Simulation& s) { s.remove_body(41); }, "there is no body 41");
    unknown([](Simulation& s) { s.remove_body(7); }, "body 7 was removed");
    unknown([](Simulation& s) { s.set_velocity(7, kNone, kNone); }, "body 7 was removed");
    unknown([](Simulation& s) { s.set_force(7, kNone, kNone); }, "body 7 was removed");
    unknown([](Simulation& s) { s.set_placement(7, {}); }, "body 7 was removed");
    unknown([](Simulation& s) { s.body_state(7); }, "body 7 was removed");
    unknown([](Simulation& s) { s.slot_of(7); }, "body 7 was removed");
    unknown([](Simulation& s) { s.closest(1, 7); }, "body 7 was removed");
    unknown([](Simulation& s) { s.remove_joint(4); }, "there is no joint 4");
    unknown([](Simulation& s) { s.remove_coupling(0); }, "there is no coupling 0");
    unknown(
        [](Simulation& s) {
            JointSpec joint;
            joint.body_a = 1, joint.body_b = 7;
            s.add_joint(joint);
        },
        "body 7 was removed");
    unknown([](Simulation& s) { s.add_joint({}); }, "there is no body");
    unknown(
        [](Simulation& s) {
            CouplingSpec coupling;
            coupling.joint_a = 0, coupling.joint_b = 9;
            s.add_coupling(coupling);
        },
        "there is no joint 9");
}

TEST(BadEdits, OfNumbers) {
    const auto bad = [](auto edit, const std::string& words) {
        expect_no_trace<std::invalid_argument>(edit, words);
    };
    const Vector far(kInfinite, 0, 0);
    bad([&](Simulation& s) { s.set_velocity(1, far, {0, 0, 0}); }, "finite");
    bad([&](Simulation& s) { s.set_force(1, {0, 0, 0}, far); }, "finite");
    bad([&](Simulation& s) { s.set_placement(1, {far, Rotation::Identity()}); }, "finite");
    bad(
        [&](Simulation& s) {
            s.set_placement(1, {{0, 0, 0}, Rotation(0, 0, 0, 0)});
        },
        "other than 0");
    bad([&](Simulation& s) { s.set_velocity(0, {1, 0, 0}, {0, 0, 0}); }, "fixed");
    bad([&](Simulation& s) { s.set_force(0, {1, 0, 0}, {0, 0, 0}); }, "dynamic");
    bad([&](Simulation& s) { s.set_motor_target(3, kTurnX, kInfinite); }, "finite");
    bad([&](Simulation& s) { s.set_motor_target(3, kTurnX, kNan); }, "finite");
    bad([&](Simulation& s) { s.set_motor_target(3, kTurnX, 1e300); }, "within");
    bad([&](Simulation& s) { s.set_motor_target(0, kTurnX, 1); }, "no motor");
    bad([&](Simulation& s) { s.add_material({"", -1, 0, 0, 0, 0}); }, "0 or above");
    bad([&](Simulation& s) { s.add_material({"", 1, 0, 2, 0, 0}); }, "1 or below");
    expect_no_trace<SceneError>(
        [](Simulation& s) {
            Geometry mesh;
            mesh.kind = ShapeKind::mesh;
            mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
            mesh.triangles = {{0, 1, 3}};
            s.add_geometry(mesh);
        },
        "corners that there are not");
}

TEST(BadEdits, KeyframesHaveTheLastWord) {
    Scene scene;
    BodySpec& body = add_body(scene, box(1, 1, 1), {0, 0, 0}, Motion::kinematic);
    body.script.keyframes = {{0, {}}, {1, {{1, 0, 0}, Rotation::Identity()}}};
    Simulation s(scene, colliders(), "reference");
    EXPECT_THROW(s.set_placement(0, {}), std::invalid_argument);
    EXPECT_THROW(s.set_velocity(0, {0, 0, 0}, {0, 0, 0}), std::invalid_argument);
}

/// The first pair of kinds, of those that a body may have and move with, that a plugin lacks.
TEST(BadEdits, OfPairsThatTheColliderCannotDo) {
    Scene scene = heap();
    Geometry hills;
    hills.kind = ShapeKind::height_field;
    hills.rows = hills.columns = 2;
    hills.spacing_x = hills.spacing_z = 1;
    hills.heights = {0, 0, 0, 0};
    const ColliderInfo& info = colliders().find("reference");
    const auto box_on_hills =
        info.table
            ->pairs[static_cast<int>(ShapeKind::box)][static_cast<int>(ShapeKind::height_field)];
    ASSERT_EQ(box_on_hills, 0u) << "the reference does height fields now: take another pair";
    Simulation s(scene, colliders(), "reference"), quiet(scene, colliders(), "reference");
    for (int i = 0; i < 10; ++i) s.step(), quiet.step();
    BodySpec body = body_of(s.add_geometry(hills), {0, -5, 0});
    body.motion = Motion::fixed;
    body.name = "hills";
    expect_refusal<ColliderError>([&] { s.add_body(body); }, "against height_field");
    expect_refusal<ColliderError>([&] { s.add_body(body); }, "\"hills\"");
    expect_refusal<ColliderError>([&] { s.add_body(body); }, "able are: ");
    expect_refusal<ColliderError>([&] { s.add_body(body); }, "ode");
    for (int i = 0; i < 20; ++i) s.step(), quiet.step();
    EXPECT_EQ(hash_of(s), hash_of(quiet));
}

/// Takes so many bodies, and may keep them.
class Fussy : public Proximity {
public:
    std::uint32_t room = 0, bodies = 0;
    bool lets_go = true, excludes = true;

    Status add(std::uint32_t, const ShapePlacement&) noexcept override {
        if (bodies == room) return {Status::out_of_memory, 0, "no room for more bodies"};
        return ++bodies, ok_status();
    }
    Status remove(std::uint32_t) noexcept override {
        if (!lets_go) return {Status::unsupported, 0, "bodies are for ever"};
        return --bodies, ok_status();
    }
    Status exclude(std::uint32_t, std::uint32_t, bool) noexcept override {
        if (!excludes) return {Status::unsupported, 0, "all pairs count"};
        return ok_status();
    }
    DetectStats stats() const noexcept override { return {}; }
    Status detect(const DetectRequest&, const ContactSink*, std::uint32_t) noexcept override {
        return ok_status();
    }
};

TEST(BadEdits, ThatAColliderOfOnesOwnRefuses) {
    const Scene scene = heap();
    Fussy collider;
    collider.room = static_cast<std::uint32_t>(scene.bodies.size());
    Simulation s(scene, collider, "fussy");
    s.step();
    const std::uint64_t hash = hash_of(s);
    expect_refusal<ColliderError>([&] { s.add_body(body_of(1, {0, 0, 0})); }, "no room for more");
    collider.lets_go = collider.excludes = false;
    expect_refusal<ColliderError>([&] { s.remove_body(3); }, "for ever");
    JointSpec joint;
    joint.body_a = 1, joint.body_b = 2;
    expect_refusal<ColliderError>([&] { s.add_joint(joint); }, "all pairs count");
    EXPECT_EQ(hash_of(s), hash);
    EXPECT_EQ(s.world().joints.size(), 0u);
    EXPECT_TRUE(s.world().excluded.empty());
    EXPECT_TRUE(s.has_body(3));
    EXPECT_EQ(s.world().bodies.size(), scene.bodies.size());
    collider.room += 1;
    EXPECT_EQ(s.add_body(body_of(1, {0, 0, 0})), scene.bodies.size());
}

/// A source of contacts that knows two bodies and finds nothing.
class Elsewhere : public ContactSource {
public:
    const SourceInfo& info() const override { return info_; }
    ContactAnswer ask(const ContactQuestion&) override { return {}; }

private:
    SourceInfo info_{"elsewhere", "", ""};
};

TEST(BadEdits, OfAColliderInAnotherProcess) {
    Scene scene;
    add_ground(scene);
    add_body(scene, sphere(1), {0, 9, 0});
    Elsewhere source;
    SourceProximity collider(source);
    Simulation s(scene, collider, "elsewhere");
    s.step();
    expect_refusal<ColliderError>([&] { s.add_body(body_of(1, {0, 5, 0})); }, "another process");
    expect_refusal<ColliderError>([&] { s.remove_body(1); }, "another process");
    s.step();
    EXPECT_EQ(s.world().bodies.size(), 2u);
}

/// The first body that calls for contacts brings all the others to the collider, or none.
TEST(BadEdits, ThatWouldHaveBroughtTheFirstContacts) {
    Scene scene;
    add_ground(scene);
    Fussy collider;
    collider.room = 1;
    Simulation s(scene, collider, "fussy");
    const std::uint32_t ball = s.add_geometry(sphere(1));
    expect_refusal<ColliderError>([&] { s.add_body(body_of(ball, {0, 5, 0})); }, "no room");
    EXPECT_EQ(collider.bodies, 0u);
    EXPECT_FALSE(s.plan().runs(Effect::contacts));
    EXPECT_EQ(s.world().bodies.size(), 1u);
    collider.room = 2;
    EXPECT_EQ(s.add_body(body_of(ball, {0, 5, 0})), 1u);
    EXPECT_EQ(collider.bodies, 2u);
    EXPECT_TRUE(s.plan().runs(Effect::contacts));
}

}  // namespace
}  // namespace plumb::test
