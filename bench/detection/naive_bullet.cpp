// SPDX-License-Identifier: MIT
/// Bullet in double precision: dynamic tree, dispatcher and persistent manifolds.
#include "detection/naive.h"

#include <btBulletCollisionCommon.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace plumb::bench {

const char* const kPlugin = "bullet";

namespace {

class Bullet final : public NaiveDetector {
public:
    explicit Bullet(const Scene& scene) {
        for (const BodySpec& body : scene.bodies) {
            shapes_.push_back(make(scene.geometries[body.geometry]));
            objects_.push_back(std::make_unique<btCollisionObject>());
            objects_.back()->setCollisionShape(shapes_.back().get());
            const bool dynamic = body.motion == Motion::dynamic;
            // What does not move only meets what does.
            world_.addCollisionObject(objects_.back().get(), dynamic ? 1 : 2, dynamic ? 3 : 1);
        }
    }
    ~Bullet() override {
        for (const auto& object : objects_) world_.removeCollisionObject(object.get());
    }

    void move(std::size_t i, const Placement& p) override {
        const Eigen::Vector3d& x = p.position;
        const Eigen::Quaterniond& q = p.rotation;
        objects_[i]->setWorldTransform(
            btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), btVector3(x.x(), x.y(), x.z())));
    }

    std::size_t detect() override {
        world_.performDiscreteCollisionDetection();
        std::size_t points = 0;
        for (int i = 0; i < dispatcher_.getNumManifolds(); ++i)
            points += static_cast<std::size_t>(
                dispatcher_.getManifoldByIndexInternal(i)->getNumContacts());
        return points;
    }

private:
    static std::unique_ptr<btCollisionShape> make(const Geometry& g) {
        const Eigen::Vector3d& h = g.half_extents;
        if (g.kind == ShapeKind::plane)
            return std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), 0);
        if (g.kind == ShapeKind::box)
            return std::make_unique<btBoxShape>(btVector3(h.x(), h.y(), h.z()));
        if (g.kind == ShapeKind::sphere) return std::make_unique<btSphereShape>(g.radius);
        std::fprintf(stderr, "this bench knows planes, boxes and spheres\n");
        std::exit(3);
    }

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broad_;
    btCollisionWorld world_{&dispatcher_, &broad_, &configuration_};
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

}  // namespace

std::unique_ptr<NaiveDetector> make_naive(const Scene& scene) {
    return std::make_unique<Bullet>(scene);
}

}  // namespace plumb::bench
