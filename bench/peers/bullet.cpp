// SPDX-License-Identifier: MIT
/// A scene of planes, boxes and spheres on Bullet's own dynamics (single precision, as packaged),
/// without sleeping.
#include "peer.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#include <btBulletDynamicsCommon.h>
#pragma GCC diagnostic pop

#include <cmath>
#include <map>
#include <memory>

namespace {

using plumb::peer::now_ms;

class TimedWorld : public btDiscreteDynamicsWorld {
public:
    using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;
    double detect = 0, solve = 0;

protected:
    void performDiscreteCollisionDetection() override {
        const double t = now_ms();
        btDiscreteDynamicsWorld::performDiscreteCollisionDetection();
        detect += now_ms() - t;
    }
    void solveConstraints(btContactSolverInfo& info) override {
        const double t = now_ms();
        btDiscreteDynamicsWorld::solveConstraints(info);
        solve += now_ms() - t;
    }
};

btScalar scalar(double x) { return static_cast<btScalar>(x); }
btVector3 vector(const Eigen::Vector3d& v) { return {scalar(v.x()), scalar(v.y()), scalar(v.z())}; }

/// A half-space becomes a large box, which Bullet handles with full manifolds.
std::unique_ptr<btCollisionShape> make_shape(const plumb::Geometry& g, Eigen::Vector3d& shift) {
    switch (g.kind) {
        case plumb::ShapeKind::plane:
            shift = {0, -1, 0};
            return std::make_unique<btBoxShape>(btVector3(100, 1, 100));
        case plumb::ShapeKind::box:
            return std::make_unique<btBoxShape>(vector(g.half_extents));
        case plumb::ShapeKind::sphere:
            return std::make_unique<btSphereShape>(scalar(g.radius));
        default:
            std::fprintf(stderr, "this peer knows planes, boxes and spheres\n");
            std::exit(3);
    }
}

double volume(const plumb::Geometry& g) {
    return g.kind == plumb::ShapeKind::sphere ? 4.0 / 3 * M_PI * g.radius * g.radius * g.radius
                                              : 8 * g.half_extents.prod();
}

}  // namespace

int main(int argc, char** argv) {
    const auto [scene, iterations] = plumb::peer::arguments(argc, argv);
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    TimedWorld world(&dispatcher, &broadphase, &solver, &configuration);
    world.setGravity(vector(scene.settings.gravity));
    world.getSolverInfo().m_numIterations = iterations;

    std::map<std::uint32_t, std::pair<std::unique_ptr<btCollisionShape>, Eigen::Vector3d>> shapes;
    std::vector<std::unique_ptr<btRigidBody>> bodies;
    for (const plumb::BodySpec& spec : scene.bodies) {
        const plumb::Geometry& g = scene.geometries[spec.geometry];
        auto& [shape, shift] = shapes[spec.geometry];
        if (!shape) shift.setZero(), shape = make_shape(g, shift);
        const bool dynamic = spec.motion == plumb::Motion::dynamic;
        const btScalar mass =
            dynamic ? scalar(spec.mass.value_or(plumb::peer::density_of(scene, spec) * volume(g)))
                    : 0;
        btVector3 inertia(0, 0, 0);
        if (dynamic) shape->calculateLocalInertia(mass, inertia);
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
        const Eigen::Quaterniond& q = spec.placement.rotation;
        info.m_startWorldTransform =
            btTransform(btQuaternion(scalar(q.x()), scalar(q.y()), scalar(q.z()), scalar(q.w())),
                        vector(spec.placement.position + q * shift));
        info.m_friction =
            scalar(std::sqrt(scene.materials[spec.material].friction));  // Bullet multiplies
        bodies.push_back(std::make_unique<btRigidBody>(info));
        bodies.back()->setActivationState(DISABLE_DEACTIVATION);
        bodies.back()->setLinearVelocity(vector(spec.velocity));
        bodies.back()->setAngularVelocity(vector(spec.angular_velocity));
        world.addRigidBody(bodies.back().get(), dynamic ? 1 : 2, dynamic ? 3 : 1);
    }

    plumb::peer::Times times;
    for (int step = 0; step < plumb::peer::kSteps; ++step) {
        world.detect = world.solve = 0;
        const double t = now_ms();
        world.stepSimulation(scalar(scene.settings.dt), 0);
        if (step < plumb::peer::kMeasuredFrom) continue;
        times.step.push_back(now_ms() - t);
        times.detect.push_back(world.detect);
        times.solve.push_back(world.solve);
        int points = 0;
        for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
            points += dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
        times.points.push_back(points);
    }
    times.print("Bullet", scene, iterations);
    for (auto& body : bodies) world.removeRigidBody(body.get());
    return 0;
}
