// SPDX-License-Identifier: MIT
/// DART 6.12: contacts by Dantzig's direct solver, its default ("dart"), and by Gauss and Seidel's
/// iterations ("dart quick").
///
/// Its own defaults for ERP (0.01), the greatest speed of a push out (1 mm/s), CFM (1e-5 of the
/// diagonal) and friction (a pyramid). Its own collision detector, which has boxes and spheres in
/// closed form; a plane is a large box. The iterations end by their number only. Joints make trees
/// in generalized coordinates; what closes a loop is a constraint. Springs are forces, for those of
/// DART's joints are damped by implicit Euler.
#include "accuracy/dart_solver.h"
#include "accuracy/peer.h"
#include "accuracy/tree.h"

#include <dart/collision/dart/dart.hpp>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>

#include <cmath>
#include <iostream>

namespace plumb::bench {
namespace {

namespace dyn = dart::dynamics;

constexpr int kIterations = 30;
constexpr double kRunaway = 1e6;            // of a joint's speed; beyond it DART aborts
constexpr double kGround = 100, kDeep = 1;  // half extents of a plane's box [m]

Eigen::Isometry3d to_dart(const Placement& p) {
    Eigen::Isometry3d at = Eigen::Isometry3d::Identity();
    at.linear() = p.rotation.toRotationMatrix();
    at.translation() = p.position;
    return at;
}

class DartPeer : public Peer {
public:
    DartPeer(const Scene& scene, const World& world, const Fineness& f, bool quick)
        : start_(world), bodies_(scene.bodies.size()) {
        world_->setConstraintSolver(dart_solver(quick ? f.iterations : 0));
        world_->getConstraintSolver()->setCollisionDetector(
            dart::collision::DARTCollisionDetector::create());
        world_->setGravity(scene.settings.gravity);
        world_->setTimeStep(f.dt);
        const Trees found = trees(scene, world);
        for (const Hanging& hanging : found.bodies) add_body(scene, hanging);
        for (std::uint32_t i = 0; i < scene.bodies.size(); ++i)
            if (!is_dynamic(world, i)) add_fixed(scene, i);
        for (const auto& skeleton : skeletons_) world_->addSkeleton(skeleton);
        for (const JointSpec* joint : found.loops) close(*joint);
        for (const JointSpec& joint : scene.joints)
            if (joint.compliance > 0) add_spring(joint);
    }

    void step() override {
        for (const std::size_t i : driven_) {
            bodies_[i]->addExtForce(start_.bodies.force[i]);
            bodies_[i]->addExtTorque(start_.bodies.torque[i]);
        }
        for (const Spring& spring : springs_) spring.pull();
        world_->step();
    }

    void read(World& world) override {
        for (const auto& skeleton : skeletons_)
            if (skeleton->getNumDofs() > 0 &&
                !(skeleton->getVelocities().cwiseAbs().maxCoeff() < kRunaway))
                throw EngineFailure{};
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (!is_dynamic(world, i)) continue;
            const Eigen::Isometry3d& at = bodies_[i]->getWorldTransform();
            world.bodies.position[i] = at.translation();
            world.bodies.orientation[i] = Quaterniond(at.linear());
            world.bodies.velocity[i] = bodies_[i]->getLinearVelocity();
            world.bodies.angular_velocity[i] = bodies_[i]->getAngularVelocity();
        }
    }

private:
    /// Draws a point of a to one of b, or of the world.
    struct Spring {
        dyn::BodyNode *a, *b;
        Vector3d in_a, in_b;
        double stiffness;

        void pull() const {
            const Vector3d end = b ? Vector3d(b->getWorldTransform() * in_b) : in_b;
            const Vector3d force = stiffness * (end - a->getWorldTransform() * in_a);
            a->addExtForce(force, in_a);
            if (b) b->addExtForce(-force, in_b);
        }
    };

    Placement placement(std::size_t i) const {
        return {start_.bodies.position[i], start_.bodies.orientation[i]};
    }

    /// A body's own frame is that of its principal axes.
    void add_body(const Scene& scene, const Hanging& hanging) {
        const std::uint32_t i = hanging.body;
        const Bodies& b = start_.bodies;
        dyn::BodyNode* parent = hanging.from == kNoIndex ? nullptr : bodies_[hanging.from];
        if (!parent) skeletons_.push_back(dyn::Skeleton::create(std::to_string(i)));
        dyn::Skeleton& tree = *(parent ? parent->getSkeleton() : skeletons_.back());
        if (!hanging.by)
            add_free(tree, i);
        else if (hanging.by->kind == JointKind::hinge)
            add_hinge(tree, parent, hanging);
        else
            add_ball(tree, parent, hanging);
        dyn::Inertia inertia(b.mass[i]);
        inertia.setMoment(b.inertia[i].asDiagonal().toDenseMatrix());
        bodies_[i]->setInertia(inertia);
        add_shape(scene, i);
        if (!b.force[i].isZero() || !b.torque[i].isZero()) driven_.push_back(i);
    }

    void add_free(dyn::Skeleton& tree, std::uint32_t i) {
        const auto [joint, body] = tree.createJointAndBodyNodePair<dyn::FreeJoint>();
        bodies_[i] = body;
        joint->setTransform(to_dart(placement(i)));
        joint->setLinearVelocity(start_.bodies.velocity[i]);
        joint->setAngularVelocity(start_.bodies.angular_velocity[i]);
    }

    void add_ball(dyn::Skeleton& tree, dyn::BodyNode* parent, const Hanging& hanging) {
        const auto [joint, body] = tree.createJointAndBodyNodePair<dyn::BallJoint>(parent);
        bodies_[hanging.body] = body;
        attach(*joint, hanging);
        joint->setVelocities(turning_at(hanging));
    }

    void add_hinge(dyn::Skeleton& tree, dyn::BodyNode* parent, const Hanging& hanging) {
        const auto [joint, body] = tree.createJointAndBodyNodePair<dyn::RevoluteJoint>(parent);
        bodies_[hanging.body] = body;
        joint->setAxis(Vector3d::UnitX());
        attach(*joint, hanging);
        joint->setVelocity(0, turning_at(hanging).x());
    }

    void attach(dyn::Joint& joint, const Hanging& hanging) const {
        const Placement at = joint_frame(*hanging.by);
        const Placement from = hanging.from == kNoIndex ? Placement{} : placement(hanging.from);
        joint.setTransformFromParentBodyNode(to_dart(inverse(from) * at));
        joint.setTransformFromChildBodyNode(to_dart(inverse(placement(hanging.body)) * at));
    }

    /// Angular velocity against what it hangs from, along the joint's axes [rad/s].
    Vector3d turning_at(const Hanging& hanging) const {
        Vector3d turning = start_.bodies.angular_velocity[hanging.body];
        if (hanging.from != kNoIndex) turning -= start_.bodies.angular_velocity[hanging.from];
        return hanging.by->frame.conjugate() * turning;
    }

    void add_fixed(const Scene& scene, std::uint32_t i) {
        skeletons_.push_back(dyn::Skeleton::create(std::to_string(i)));
        const auto [joint, body] = skeletons_.back()->createJointAndBodyNodePair<dyn::WeldJoint>();
        bodies_[i] = body;
        joint->setTransformFromParentBodyNode(to_dart(placement(i)));
        add_shape(scene, i);
    }

    void add_shape(const Scene& scene, std::uint32_t i) {
        if (!collides(scene) || scene.bodies[i].geometry == kNoIndex) return;
        const Geometry& g = scene.geometries[scene.bodies[i].geometry];
        Placement at = start_.bodies.geometry_in_body[i];
        dyn::ShapePtr shape;
        if (g.kind == ShapeKind::plane) {
            shape = std::make_shared<dyn::BoxShape>(2 * Vector3d(kGround, kDeep, kGround));
            at = at * Placement{{0, -kDeep, 0}, Quaterniond::Identity()};
        } else if (g.kind == ShapeKind::box) {
            shape = std::make_shared<dyn::BoxShape>(2 * g.half_extents);
        } else {
            shape = std::make_shared<dyn::SphereShape>(g.radius);
        }
        dyn::ShapeNode* node =
            bodies_[i]->createShapeNodeWith<dyn::CollisionAspect, dyn::DynamicsAspect>(shape);
        node->setRelativeTransform(to_dart(at));
        const SurfacePair& surface = start_.surface_pair(i, i);
        node->getDynamicsAspect()->setFrictionCoeff(surface.friction);  // DART takes the lesser
        node->getDynamicsAspect()->setRestitutionCoeff(
            std::sqrt(surface.restitution));  // and multiplies
    }

    void close(const JointSpec& joint) {
        const Vector3d at = joint_frame(joint).position;
        dyn::BodyNode* a = bodies_[joint.body_a];
        world_->getConstraintSolver()->addConstraint(
            joint.body_b == kNoIndex ? std::make_shared<Closure>(a, at)
                                     : std::make_shared<Closure>(a, bodies_[joint.body_b], at));
    }

    void add_spring(const JointSpec& joint) {
        const bool held = joint.body_b == kNoIndex;
        springs_.push_back(
            {bodies_[joint.body_a], held ? nullptr : bodies_[joint.body_b],
             in_body(start_.bodies, joint.body_a, joint.anchor),
             held ? joint.anchor : in_body(start_.bodies, joint.body_b, joint.anchor),
             1 / joint.compliance});
    }

    World start_;
    dart::simulation::WorldPtr world_ = dart::simulation::World::create();
    std::vector<dyn::SkeletonPtr> skeletons_;
    std::vector<dyn::BodyNode*> bodies_;  ///< [body]
    std::vector<Spring> springs_;
    std::vector<std::size_t> driven_;  ///< bodies with a constant force or torque
};

std::string unable(const Scene& scene) {
    if (!joints_are(scene, {JointKind::ball, JointKind::hinge, JointKind::distance}))
        return "only ball, hinge and distance joints are passed on";
    if (!scene.couplings.empty()) return "its gears do not act back on the wheel that drives";
    return other_shapes(scene, {ShapeKind::sphere});  // of its own detector
}

/// Of the solver nothing is seen where it has nothing to solve.
std::string unable_quick(const Scene& scene) {
    const bool touches = collides(scene) && scene.bodies.size() > 1 && scene.joints.empty();
    if (!touches && trees(scene, build_world(scene)).loops.empty())
        return "nothing touches and no loop is closed";
    return unable(scene);
}

Engine engine(const char* name, bool quick) {
    return {name, quick ? kIterations : 0, quick ? unable_quick : unable,
            [quick](const Scene& scene, const World& world, const Fineness& fineness) {
                return std::make_unique<DartPeer>(scene, world, fineness, quick);
            }};
}

}  // namespace

std::vector<Engine> engines() {
    std::cout.rdbuf(nullptr);  // where it logs
    std::cerr.rdbuf(nullptr);
    return {engine("dart", false), engine("dart quick", true)};
}

}  // namespace plumb::bench
