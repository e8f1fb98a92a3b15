// SPDX-License-Identifier: MIT
/// Bullet 3.24 in double precision: rigid bodies by sequential impulses ("bullet") and by Dantzig's
/// direct solver ("bullet direct").
///
/// Its own defaults for ERP (0.2), warm starting (on), damping (none), the gyroscopic term
/// (implicit, in the body) and friction (one direction, along the motion). Split impulse is on;
/// where bodies bounce it has no threshold, below which the push out of a penetration would add to
/// the speed. Springs are forces, for Bullet's own constraint of that kind bounds its impulse and
/// does not converge where several hang together. Bodies never sleep. A plane is a large box, on
/// which boxes stand better than on Bullet's plane.
#include "accuracy/peer.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>
#include <btBulletDynamicsCommon.h>
#pragma GCC diagnostic pop

#include <cmath>

namespace plumb::bench {
namespace {

constexpr int kIterations = 10;
constexpr double kGround = 100, kDeep = 1;  // half extents of a plane's box [m]

btVector3 to_bullet(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
btQuaternion to_bullet(const Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }
btTransform to_bullet(const Placement& p) {
    return btTransform(to_bullet(p.rotation), to_bullet(p.position));
}
Vector3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

class BulletPeer : public Peer {
public:
    BulletPeer(const Scene& scene, const World& world, const Fineness& f, bool direct)
        : start_(world), dt_(f.dt) {
        if (direct)
            solver_ = std::make_unique<btMLCPSolver>(&dantzig_);
        else
            solver_ = std::make_unique<btSequentialImpulseConstraintSolver>();
        world_ = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher_, &broadphase_,
                                                           solver_.get(), &configuration_);
        world_->setGravity(to_bullet(scene.settings.gravity));
        const auto bounces = [](const Material& m) { return m.restitution > 0; };
        if (std::any_of(scene.materials.begin(), scene.materials.end(), bounces))
            world_->getSolverInfo().m_splitImpulsePenetrationThreshold = 0;
        if (!direct) world_->getSolverInfo().m_numIterations = f.iterations;
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) add_body(scene, i);
        for (const JointSpec& joint : scene.joints) add_joint(joint);
        for (const CouplingSpec& coupling : scene.couplings) add_gear(scene, coupling);
        for (const auto& joint : joints_) world_->addConstraint(joint.get(), true);
    }
    ~BulletPeer() override {
        for (const auto& joint : joints_) world_->removeConstraint(joint.get());
        for (const auto& body : bodies_) world_->removeRigidBody(body.get());
    }
    BulletPeer(const BulletPeer&) = delete;
    BulletPeer& operator=(const BulletPeer&) = delete;

    void step() override {
        for (const std::size_t i : driven_) {
            bodies_[i]->applyCentralForce(to_bullet(start_.bodies.force[i]));
            bodies_[i]->applyTorque(to_bullet(start_.bodies.torque[i]));
        }
        for (const Spring& spring : springs_) spring.pull();
        world_->stepSimulation(dt_, 0);
    }

    void read(World& world) override {
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (!is_dynamic(world, i)) continue;
            const btTransform& at = bodies_[i]->getCenterOfMassTransform();
            const btQuaternion q = at.getRotation();
            world.bodies.position[i] = from_bullet(at.getOrigin());
            world.bodies.orientation[i] = Quaterniond(q.w(), q.x(), q.y(), q.z());
            world.bodies.velocity[i] = from_bullet(bodies_[i]->getLinearVelocity());
            world.bodies.angular_velocity[i] = from_bullet(bodies_[i]->getAngularVelocity());
        }
    }

private:
    /// Draws a point of a to one of b, or of the world.
    struct Spring {
        btRigidBody *a, *b;
        btVector3 in_a, in_b;
        btScalar stiffness;

        void pull() const {
            const btVector3 arm_a = quatRotate(a->getOrientation(), in_a),
                            arm_b = b ? quatRotate(b->getOrientation(), in_b) : in_b;
            btVector3 apart = arm_b - a->getCenterOfMassPosition() - arm_a;
            if (b) apart += b->getCenterOfMassPosition();
            a->applyForce(stiffness * apart, arm_a);
            if (b) b->applyForce(-stiffness * apart, arm_b);
        }
    };

    btCollisionShape* keep(std::unique_ptr<btCollisionShape> shape) {
        return shapes_.emplace_back(std::move(shape)).get();
    }

    /// The shape of a body, in the body's frame.
    btCollisionShape* make_shape(const Scene& scene, std::size_t i) {
        if (scene.bodies[i].geometry == kNoIndex) return keep(std::make_unique<btEmptyShape>());
        const Geometry& g = scene.geometries[scene.bodies[i].geometry];
        Placement at = start_.bodies.geometry_in_body[i];
        btCollisionShape* shape = nullptr;
        if (g.kind == ShapeKind::plane) {
            shape = keep(std::make_unique<btBoxShape>(btVector3(kGround, kDeep, kGround)));
            at = at * Placement{{0, -kDeep, 0}, Quaterniond::Identity()};
        } else if (g.kind == ShapeKind::box) {
            shape = keep(std::make_unique<btBoxShape>(to_bullet(g.half_extents)));
        } else if (g.kind == ShapeKind::cylinder) {
            shape = keep(
                std::make_unique<btCylinderShape>(btVector3(g.radius, g.half_height, g.radius)));
        } else {
            shape = keep(std::make_unique<btSphereShape>(g.radius));
        }
        if (at.position.isZero() && at.rotation.isApprox(Quaterniond::Identity())) return shape;
        auto compound = std::make_unique<btCompoundShape>();
        compound->addChildShape(to_bullet(at), shape);
        return keep(std::move(compound));
    }

    void add_body(const Scene& scene, std::size_t i) {
        const Bodies& b = start_.bodies;
        btRigidBody::btRigidBodyConstructionInfo info(b.mass[i], nullptr, make_shape(scene, i),
                                                      to_bullet(b.inertia[i]));
        info.m_startWorldTransform = to_bullet(Placement{b.position[i], b.orientation[i]});
        const auto id = static_cast<std::uint32_t>(i);
        const SurfacePair& surface = start_.surface_pair(id, id);
        info.m_friction = std::sqrt(surface.friction);  // Bullet multiplies
        info.m_restitution = std::sqrt(surface.restitution);
        auto& body = bodies_.emplace_back(std::make_unique<btRigidBody>(info));
        body->setActivationState(DISABLE_DEACTIVATION);
        body->setLinearVelocity(to_bullet(b.velocity[i]));
        body->setAngularVelocity(to_bullet(b.angular_velocity[i]));
        world_->addRigidBody(body.get(), 1, collides(scene) ? 1 : 0);
        if (!b.force[i].isZero() || !b.torque[i].isZero()) driven_.push_back(i);
    }

    btVector3 local(std::uint32_t body, const Vector3d& point) const {
        return to_bullet(in_body(start_.bodies, body, point));
    }
    btVector3 local_axis(const JointSpec& joint, std::uint32_t body) const {
        return to_bullet(Vector3d(start_.bodies.orientation[body].conjugate() * joint.frame *
                                  Vector3d::UnitX()));
    }

    /// A rod is rigid with its body a: a chain that hangs straight is the same.
    void add_joint(const JointSpec& joint) {
        const std::uint32_t a = joint.body_a, b = joint.body_b;
        const Vector3d at = joint.anchor_b.value_or(joint.anchor);
        if (joint.compliance > 0) return add_spring(joint);
        if (joint.kind == JointKind::hinge && b == kNoIndex)
            add<btHingeConstraint>(*bodies_[a], local(a, at), local_axis(joint, a));
        else if (joint.kind == JointKind::hinge)
            add<btHingeConstraint>(*bodies_[a], *bodies_[b], local(a, at), local(b, at),
                                   local_axis(joint, a), local_axis(joint, b));
        else if (b == kNoIndex)
            add<btPoint2PointConstraint>(*bodies_[a], local(a, at));
        else
            add<btPoint2PointConstraint>(*bodies_[a], *bodies_[b], local(a, at), local(b, at));
    }

    void add_spring(const JointSpec& joint) {
        const bool held = joint.body_b == kNoIndex;
        springs_.push_back({bodies_[joint.body_a].get(),
                            held ? nullptr : bodies_[joint.body_b].get(),
                            local(joint.body_a, joint.anchor),
                            held ? to_bullet(joint.anchor) : local(joint.body_b, joint.anchor),
                            1 / joint.compliance});
    }

    void add_gear(const Scene& scene, const CouplingSpec& coupling) {
        const JointSpec &first = scene.joints[coupling.joint_a],
                        &second = scene.joints[coupling.joint_b];
        add<btGearConstraint>(*bodies_[first.body_a], *bodies_[second.body_a],
                              local_axis(first, first.body_a), local_axis(second, second.body_a),
                              -1 / coupling.ratio);
    }

    template <class J, class... A>
    J& add(A&&... arguments) {
        auto joint = std::make_unique<J>(std::forward<A>(arguments)...);
        J& made = *joint;
        joints_.push_back(std::move(joint));
        return made;
    }

    World start_;
    double dt_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btDantzigSolver dantzig_;
    std::unique_ptr<btConstraintSolver> solver_;
    std::unique_ptr<btDiscreteDynamicsWorld> world_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;  ///< [body]
    std::vector<std::unique_ptr<btTypedConstraint>> joints_;
    std::vector<Spring> springs_;
    std::vector<std::size_t> driven_;  ///< bodies with a constant force or torque
};

std::string unable(const Scene& scene) {
    if (!joints_are(scene, {JointKind::ball, JointKind::hinge, JointKind::distance}))
        return "only ball, hinge and distance joints are passed on";
    return other_shapes(scene, {ShapeKind::sphere, ShapeKind::cylinder});
}

Engine engine(const char* name, bool direct) {
    return {name, direct ? 0 : kIterations, unable,
            [direct](const Scene& scene, const World& world, const Fineness& fineness) {
                return std::make_unique<BulletPeer>(scene, world, fineness, direct);
            }};
}

}  // namespace

std::vector<Engine> engines() { return {engine("bullet", false), engine("bullet direct", true)}; }

}  // namespace plumb::bench
