// SPDX-License-Identifier: MIT
/// Simbody 3.7: Merson's Runge and Kutta of fourth order ("simbody"), which its examples use, and
/// Verlet ("simbody Verlet"), both in fixed steps; where bodies touch, its time stepper for rigid
/// contacts ("simbody rigid"), since the contacts of its integrators are compliant.
///
/// Joints make trees in generalized coordinates; what closes a loop, and a gear, is a constraint.
/// Springs are bushings without stiffness against turns. The stepper has its own defaults (direct
/// solver, Poisson's restitution), but repairs overlaps only, with which stacks stand. A library
/// with assertions, as Debian's is, prints what its stepper does: of such a one it is left out.
#include "accuracy/peer.h"
#include "accuracy/simbody_contacts.h"
#include "accuracy/tree.h"

#include <cstring>
#include <limits>

namespace plumb::bench {
namespace {

constexpr double kTolerance = 1e-9;  // of constraints [m]; below it rounding stops the projection
constexpr double kAccuracy = 1e-6;   // to which Verlet iterates

enum class Method { merson, verlet, rigid };

/// Bodies that may touch: those of a scene without joints, whose bodies never meet in the cases.
bool touches(const Scene& scene) {
    return collides(scene) && scene.joints.empty() && scene.bodies.size() > 1;
}

/// A joint's frame with its axis along z, about which Simbody's hinges turn.
Placement pin_frame(const JointSpec& joint) {
    Placement at = joint_frame(joint);
    at.rotation = at.rotation * Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d::UnitX());
    return at;
}

class SimbodyPeer : public Peer {
public:
    SimbodyPeer(const Scene& scene, const World& world, const Fineness& f, Method method)
        : start_(world), dt_(f.dt), bodies_(scene.bodies.size(), matter_.updGround()) {
        if (!scene.settings.gravity.isZero())
            st::Force::UniformGravity(forces_, matter_, to_simbody(scene.settings.gravity));
        const Trees found = trees(scene, world);
        for (const Hanging& hanging : found.bodies) add_body(hanging);
        for (const JointSpec* joint : found.loops) close(*joint);
        for (const JointSpec& joint : scene.joints)
            if (joint.compliance > 0) add_spring(joint);
        for (const CouplingSpec& coupling : scene.couplings) add_gear(scene, coupling);
        if (touches(scene)) add_contacts(matter_, bodies_, scene, world);
        st::State state = system_.realizeTopology();
        system_.realizeModel(state);
        for (const Hanging& hanging : found.bodies) set_going(state, hanging);
        begin(state, method);
    }

    void step() override {
        guarded([&] {
            if (stepper_) {
                stepper_->stepTo(static_cast<double>(++steps_) * dt_);
                return;
            }
            const double before = integrator_->getTime();
            while (!(integrator_->getTime() > before))
                integrator_->stepTo(std::numeric_limits<double>::infinity());
        });
    }

    void read(World& world) override {
        guarded([&] {
            const st::State& state = stepper_ ? stepper_->getState() : integrator_->getState();
            system_.realize(state, st::Stage::Velocity);
            for (std::size_t i = 0; i < bodies_.size(); ++i)
                if (is_dynamic(world, i)) read(world.bodies, state, i);
        });
    }

private:
    template <class F>
    static void guarded(const F& act) {
        try {
            act();
        } catch (const std::exception&) {
            throw EngineFailure{};
        }
    }

    void read(Bodies& b, const st::State& state, std::size_t i) const {
        const st::Transform& at = bodies_[i].getBodyTransform(state);
        const st::Quaternion q = at.R().convertRotationToQuaternion();
        b.position[i] = from_simbody(at.p());
        b.orientation[i] = Quaterniond(q[0], q[1], q[2], q[3]);
        b.velocity[i] = from_simbody(bodies_[i].getBodyOriginVelocity(state));
        b.angular_velocity[i] = from_simbody(bodies_[i].getBodyAngularVelocity(state));
    }

    void begin(const st::State& state, Method method) {
        if (method == Method::rigid) {
            stepper_ = std::make_unique<st::SemiExplicitEulerTimeStepper>(system_);
            stepper_->setConstraintTolerance(kTolerance);
            stepper_->setPositionProjectionMethod(st::SemiExplicitEulerTimeStepper::Unilateral);
            return stepper_->initialize(state);
        }
        if (method == Method::merson)
            integrator_ = std::make_unique<st::RungeKuttaMersonIntegrator>(system_);
        else
            integrator_ = std::make_unique<st::VerletIntegrator>(system_);
        integrator_->setFixedStepSize(dt_);
        integrator_->setAccuracy(kAccuracy);
        integrator_->setConstraintTolerance(kTolerance);
        integrator_->setReturnEveryInternalStep(true);
        integrator_->initialize(state);
    }

    Placement placement(std::uint32_t i) const {
        if (i == kNoIndex) return {};
        return {start_.bodies.position[i], start_.bodies.orientation[i]};
    }
    st::MobilizedBody& body(std::uint32_t i) {
        return i == kNoIndex ? matter_.updGround() : bodies_[i];
    }
    st::Transform local(std::uint32_t i, const Placement& at) const {
        return to_simbody(inverse(placement(i)) * at);
    }
    st::Vec3 local(std::uint32_t i, const Vector3d& point) const {
        return local(i, Placement{point, Quaterniond::Identity()}).p();
    }

    /// A body's own frame is that of its principal axes.
    void add_body(const Hanging& hanging) {
        const std::uint32_t i = hanging.body;
        const Bodies& b = start_.bodies;
        const st::Body::Rigid mass(
            st::MassProperties(b.mass[i], st::Vec3(0), st::Inertia(to_simbody(b.inertia[i]))));
        st::MobilizedBody& parent = body(hanging.from);
        const Placement at = !hanging.by                            ? placement(i)
                             : hanging.by->kind == JointKind::hinge ? pin_frame(*hanging.by)
                                                                    : joint_frame(*hanging.by);
        const st::Transform in_parent = local(hanging.from, at), in_body = local(i, at);
        if (!hanging.by)
            bodies_[i] = st::MobilizedBody::Free(parent, in_parent, mass, in_body);
        else if (hanging.by->kind == JointKind::hinge)
            bodies_[i] = st::MobilizedBody::Pin(parent, in_parent, mass, in_body);
        else
            bodies_[i] = st::MobilizedBody::Ball(parent, in_parent, mass, in_body);
        if (!b.force[i].isZero())
            st::Force::ConstantForce(forces_, bodies_[i], st::Vec3(0), to_simbody(b.force[i]));
        if (!b.torque[i].isZero())
            st::Force::ConstantTorque(forces_, bodies_[i], to_simbody(b.torque[i]));
    }

    void set_going(st::State& state, const Hanging& hanging) const {
        const std::uint32_t i = hanging.body;
        const Bodies& b = start_.bodies;
        Vector3d turning = b.angular_velocity[i];
        if (hanging.from != kNoIndex) turning -= b.angular_velocity[hanging.from];
        const Quaterniond frame = !hanging.by ? b.orientation[i]
                                  : hanging.by->kind == JointKind::hinge
                                      ? pin_frame(*hanging.by).rotation
                                      : hanging.by->frame;
        bodies_[i].setUToFitAngularVelocity(state, to_simbody(frame.conjugate() * turning));
        if (!hanging.by)
            bodies_[i].setUToFitLinearVelocity(state,
                                               to_simbody(frame.conjugate() * b.velocity[i]));
    }

    void close(const JointSpec& joint) {
        const Vector3d at = joint_frame(joint).position;
        st::Constraint::Ball(body(joint.body_a), local(joint.body_a, at), body(joint.body_b),
                             local(joint.body_b, at));
    }

    void add_spring(const JointSpec& joint) {
        const Placement at{joint.anchor, Quaterniond::Identity()};
        const double k = 1 / joint.compliance;
        st::Force::LinearBushing(forces_, body(joint.body_b), local(joint.body_b, at),
                                 body(joint.body_a), local(joint.body_a, at),
                                 st::Vec6(0, 0, 0, k, k, k), st::Vec6(0));
    }

    /// Both joints hold their body a to the world.
    void add_gear(const Scene& scene, const CouplingSpec& coupling) {
        st::Vector weights(3, 0.0);
        weights[0] = coupling.ratio, weights[1] = -1;
        st::Array_<st::MobilizedBodyIndex> wheels;
        for (const std::uint32_t joint : {coupling.joint_a, coupling.joint_b})
            wheels.push_back(bodies_[scene.joints[joint].body_a].getMobilizedBodyIndex());
        st::Constraint::CoordinateCoupler(
            matter_, new st::Function::Linear(weights), wheels,
            st::Array_<st::MobilizerQIndex>(2, st::MobilizerQIndex(0)));
    }

    World start_;
    double dt_;
    long long steps_ = 0;
    st::MultibodySystem system_;
    st::SimbodyMatterSubsystem matter_{system_};
    st::GeneralForceSubsystem forces_{system_};
    std::vector<st::MobilizedBody> bodies_;  ///< [body]; the ground where it is fixed
    std::unique_ptr<st::Integrator> integrator_;
    std::unique_ptr<st::SemiExplicitEulerTimeStepper> stepper_;
};

/// Whether the library was built with assertions.
bool has_assertions() {
    char kind[16] = "";
    SimTK_about_simbody("debug", sizeof kind, kind);
    return std::strcmp(kind, "debug") == 0;
}

std::string unable(const Scene& scene, Method method) {
    if (!joints_are(scene, {JointKind::ball, JointKind::hinge, JointKind::distance}))
        return "only ball, hinge and distance joints are passed on";
    if (method == Method::rigid && !touches(scene)) return "nothing touches";
    if (method != Method::rigid && touches(scene)) return "its integrators have no rigid contacts";
    if (method == Method::rigid && has_assertions())
        return "its stepper prints each step in a library with assertions, as Debian's is";
    return other_shapes(scene, {ShapeKind::sphere});
}

Engine engine(const char* name, Method method) {
    return {name, 0, [method](const Scene& scene) { return unable(scene, method); },
            [method](const Scene& scene, const World& world, const Fineness& fineness) {
                return std::make_unique<SimbodyPeer>(scene, world, fineness, method);
            }};
}

}  // namespace

std::vector<Engine> engines() {
    return {engine("simbody", Method::merson), engine("simbody Verlet", Method::verlet),
            engine("simbody rigid", Method::rigid)};
}

}  // namespace plumb::bench
