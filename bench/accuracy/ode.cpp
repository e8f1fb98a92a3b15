// SPDX-License-Identifier: MIT
/// ODE 0.16 in double precision, by its direct solver ("ode") and by its iterations ("ode quick").
///
/// Its own defaults for CFM (1e-10), the gyroscopic term (on) and the ERP of contacts (0.2); that
/// of joints is 0.5, with which chains and pendulums are more exact than with 0.2. Turns are
/// integrated as finite rotations, which the manual advises for bodies that spin fast. The contact
/// layer has no depth, for what rests shall stay where it was put; friction is the pyramid along
/// the motion.
#include "accuracy/peer.h"

#include <ode/ode.h>

#include <cstdarg>

namespace plumb::bench {
namespace {

constexpr int kContacts = 8;  // of a pair
constexpr int kIterations = 20;
constexpr double kJointErp = 0.5, kContactErp = 0.2;  // share of an error removed in a step

class OdePeer : public Peer {
public:
    OdePeer(const Scene& scene, const World& world, const Fineness& f, bool quick)
        : start_(world), dt_(f.dt), quick_(quick) {
        const Vector3d& g = scene.settings.gravity;
        dWorldSetGravity(world_, g.x(), g.y(), g.z());
        dWorldSetQuickStepNumIterations(world_, f.iterations);
        dWorldSetAutoDisableFlag(world_, 0);
        dWorldSetERP(world_, kJointErp);
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            bodies_.push_back(is_dynamic(world, i) ? make_body(i) : nullptr);
            if (collides(scene) && scene.bodies[i].geometry != kNoIndex)
                add_geom(scene.geometries[scene.bodies[i].geometry], i);
        }
        for (const JointSpec& joint : scene.joints) add_joint(joint);
        for (const CouplingSpec& coupling : scene.couplings) add_gear(scene, coupling);
    }
    ~OdePeer() override {
        dJointGroupDestroy(contacts_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }
    OdePeer(const OdePeer&) = delete;
    OdePeer& operator=(const OdePeer&) = delete;

    void step() override {
        for (const std::size_t i : driven_) {
            const Vector3d &force = start_.bodies.force[i], &torque = start_.bodies.torque[i];
            dBodyAddForce(bodies_[i], force.x(), force.y(), force.z());
            dBodyAddTorque(bodies_[i], torque.x(), torque.y(), torque.z());
        }
        dSpaceCollide(space_, this, [](void* self, dGeomID a, dGeomID b) {
            static_cast<OdePeer*>(self)->touch(a, b);
        });
        quick_ ? dWorldQuickStep(world_, dt_) : dWorldStep(world_, dt_);
        dJointGroupEmpty(contacts_);
    }

    void read(World& world) override {
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (!bodies_[i]) continue;
            const dReal* q = dBodyGetQuaternion(bodies_[i]);
            world.bodies.position[i] = vector(dBodyGetPosition(bodies_[i]));
            world.bodies.orientation[i] = Quaterniond(q[0], q[1], q[2], q[3]);
            world.bodies.velocity[i] = vector(dBodyGetLinearVel(bodies_[i]));
            world.bodies.angular_velocity[i] = vector(dBodyGetAngularVel(bodies_[i]));
        }
    }

private:
    static Vector3d vector(const dReal* v) { return {v[0], v[1], v[2]}; }

    dBodyID make_body(std::size_t i) {
        const Bodies& b = start_.bodies;
        const dBodyID body = dBodyCreate(world_);
        dMass mass;
        const Vector3d& inertia = b.inertia[i];
        dMassSetParameters(&mass, b.mass[i], 0, 0, 0, inertia.x(), inertia.y(), inertia.z(), 0, 0,
                           0);
        dBodySetMass(body, &mass);
        const Vector3d &x = b.position[i], &v = b.velocity[i], &w = b.angular_velocity[i];
        const Quaterniond& q = b.orientation[i];
        const dQuaternion turn = {q.w(), q.x(), q.y(), q.z()};
        dBodySetPosition(body, x.x(), x.y(), x.z());
        dBodySetQuaternion(body, turn);
        dBodySetLinearVel(body, v.x(), v.y(), v.z());
        dBodySetAngularVel(body, w.x(), w.y(), w.z());
        dBodySetFiniteRotationMode(body, 1);
        if (!b.force[i].isZero() || !b.torque[i].isZero()) driven_.push_back(i);
        return body;
    }

    void add_geom(const Geometry& g, std::size_t i) {
        Placement at = geometry_placement(start_.bodies, i);
        if (g.kind == ShapeKind::plane) {
            const Vector3d normal = at.rotation * Vector3d::UnitY();
            const dGeomID plane =
                dCreatePlane(space_, normal.x(), normal.y(), normal.z(), normal.dot(at.position));
            return number(plane, i);
        }
        const Vector3d side = 2 * g.half_extents;
        dGeomID geom = nullptr;
        if (g.kind == ShapeKind::box) {
            geom = dCreateBox(space_, side.x(), side.y(), side.z());
        } else if (g.kind == ShapeKind::cylinder) {  // about z
            geom = dCreateCylinder(space_, g.radius, 2 * g.half_height);
            at.rotation = at.rotation * z_to_y();
        } else {
            geom = dCreateSphere(space_, g.radius);
        }
        number(geom, i);
        if (bodies_[i]) dGeomSetBody(geom, bodies_[i]);
        const dQuaternion turn = {at.rotation.w(), at.rotation.x(), at.rotation.y(),
                                  at.rotation.z()};
        if (bodies_[i]) {
            dGeomSetOffsetWorldPosition(geom, at.position.x(), at.position.y(), at.position.z());
            dGeomSetOffsetWorldQuaternion(geom, turn);
        } else {
            dGeomSetPosition(geom, at.position.x(), at.position.y(), at.position.z());
            dGeomSetQuaternion(geom, turn);
        }
    }
    void number(dGeomID geom, std::size_t i) { dGeomSetData(geom, reinterpret_cast<void*>(i)); }

    void add_joint(const JointSpec& joint) {
        const dBodyID a = bodies_[joint.body_a],
                      b = joint.body_b == kNoIndex ? nullptr : bodies_[joint.body_b];
        const Vector3d &at = joint.anchor, far = joint.anchor_b.value_or(at);
        const Vector3d axis = joint.frame * Vector3d::UnitX();
        dJointID made = nullptr;
        if (joint.kind == JointKind::ball) {
            made = dJointCreateBall(world_, nullptr);
            dJointAttach(made, a, b);
            dJointSetBallAnchor(made, at.x(), at.y(), at.z());
            if (joint.compliance > 0) {  // an undamped spring, as the manual has it
                dJointSetBallParam(made, dParamERP, 1);
                dJointSetBallParam(made, dParamCFM, joint.compliance / dt_);
            }
        } else if (joint.kind == JointKind::hinge) {
            made = dJointCreateHinge(world_, nullptr);
            dJointAttach(made, a, b);
            dJointSetHingeAnchor(made, at.x(), at.y(), at.z());
            dJointSetHingeAxis(made, axis.x(), axis.y(), axis.z());
        } else {
            made = dJointCreateDBall(world_, nullptr);
            dJointAttach(made, a, b);
            dJointSetDBallAnchor1(made, at.x(), at.y(), at.z());
            dJointSetDBallAnchor2(made, far.x(), far.y(), far.z());
        }
    }

    void add_gear(const Scene& scene, const CouplingSpec& coupling) {
        const JointSpec &first = scene.joints[coupling.joint_a],
                        &second = scene.joints[coupling.joint_b];
        const Vector3d axis = first.frame * Vector3d::UnitX();
        const dJointID gear = dJointCreateTransmission(world_, nullptr);
        dJointAttach(gear, bodies_[first.body_a], bodies_[second.body_a]);
        dJointSetTransmissionMode(gear, dTransmissionParallelAxes);
        dJointSetTransmissionAnchor1(gear, first.anchor.x(), first.anchor.y(), first.anchor.z());
        dJointSetTransmissionAnchor2(gear, second.anchor.x(), second.anchor.y(), second.anchor.z());
        dJointSetTransmissionAxis(gear, axis.x(), axis.y(), axis.z());
        dJointSetTransmissionRatio(gear, -coupling.ratio);
    }

    void touch(dGeomID a, dGeomID b) {
        const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
        if (!body_a && !body_b) return;
        const auto i = static_cast<std::uint32_t>(reinterpret_cast<std::size_t>(dGeomGetData(a))),
                   j = static_cast<std::uint32_t>(reinterpret_cast<std::size_t>(dGeomGetData(b)));
        if (is_excluded(start_, i, j)) return;
        const SurfacePair& surface = start_.surface_pair(i, j);
        dContact contacts[kContacts];
        const int count = dCollide(a, b, kContacts, &contacts[0].geom, sizeof(dContact));
        for (int k = 0; k < count; ++k) {
            contacts[k].surface.mode =
                dContactApprox1 | dContactSoftERP | (surface.restitution > 0 ? dContactBounce : 0);
            contacts[k].surface.soft_erp = kContactErp;
            contacts[k].surface.mu = surface.friction;
            contacts[k].surface.bounce = surface.restitution;
            contacts[k].surface.bounce_vel = 0;
            dJointAttach(dJointCreateContact(world_, contacts_, &contacts[k]), body_a, body_b);
        }
    }

    World start_;
    double dt_;
    bool quick_;
    dWorldID world_ = dWorldCreate();
    dSpaceID space_ = dHashSpaceCreate(nullptr);
    dJointGroupID contacts_ = dJointGroupCreate(0);
    std::vector<dBodyID> bodies_;      ///< [body]; nullptr: fixed
    std::vector<std::size_t> driven_;  ///< bodies with a constant force or torque
};

std::string unable(const Scene& scene) {
    if (!joints_are(scene, {JointKind::ball, JointKind::hinge, JointKind::distance}))
        return "only ball, hinge and distance joints are passed on";
    for (const CouplingSpec& coupling : scene.couplings)
        if (coupling.ratio > 0) return "its gears are outer ones, which turn against each other";
    return other_shapes(scene, {ShapeKind::sphere, ShapeKind::cylinder});
}

Engine engine(const char* name, bool quick) {
    return {name, quick ? kIterations : 0, unable,
            [quick](const Scene& scene, const World& world, const Fineness& fineness) {
                return std::make_unique<OdePeer>(scene, world, fineness, quick);
            }};
}

}  // namespace

std::vector<Engine> engines() {
    static const bool ready = dInitODE2(0) != 0;
    if (!ready) return {};
    dSetMessageHandler([](int, const char*, va_list) {});
    dSetDebugHandler([](int, const char*, va_list) { throw EngineFailure{}; });
    return {engine("ode", false), engine("ode quick", true)};
}

}  // namespace plumb::bench
