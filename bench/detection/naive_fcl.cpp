// SPDX-License-Identifier: MIT
/// FCL: dynamic tree and collide() on each pair. Half-spaces are asked by hand against every body,
/// as FCL's tree takes no infinite box.
#include "detection/naive.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/narrowphase/collision.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace plumb::bench {

const char* const kPlugin = "fcl";

namespace {

using Object = fcl::CollisionObjectd;

class Fcl final : public NaiveDetector {
public:
    explicit Fcl(const Scene& scene) {
        for (const BodySpec& body : scene.bodies) {
            const Geometry& g = scene.geometries[body.geometry];
            objects_.push_back(std::make_unique<Object>(make(g)));
            const bool dynamic = body.motion == Motion::dynamic;
            objects_.back()->setUserData(dynamic ? this : nullptr);
            if (g.kind == ShapeKind::plane)
                planes_.push_back(objects_.back().get());
            else
                manager_.registerObject(objects_.back().get());
        }
        manager_.setup();
    }

    void move(std::size_t i, const Placement& p) override {
        objects_[i]->setTransform(p.rotation, p.position);
        objects_[i]->computeAABB();
    }

    std::size_t detect() override {
        points_ = 0;
        manager_.update();
        manager_.collide(this, [](Object* a, Object* b, void* self) {
            static_cast<Fcl*>(self)->meet(a, b);
            return false;
        });
        for (Object* plane : planes_)
            for (const auto& object : objects_)
                if (object->getUserData()) meet(plane, object.get());
        return points_;
    }

private:
    void meet(Object* a, Object* b) {
        if (!a->getUserData() && !b->getUserData()) return;
        const fcl::CollisionRequestd request(8, true);
        fcl::CollisionResultd result;
        points_ += fcl::collide(a, b, request, result);
    }

    static std::shared_ptr<fcl::CollisionGeometryd> make(const Geometry& g) {
        const Eigen::Vector3d s = 2 * g.half_extents;
        if (g.kind == ShapeKind::plane)
            return std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitY(), 0);
        if (g.kind == ShapeKind::box) return std::make_shared<fcl::Boxd>(s.x(), s.y(), s.z());
        if (g.kind == ShapeKind::sphere) return std::make_shared<fcl::Sphered>(g.radius);
        std::fprintf(stderr, "this bench knows planes, boxes and spheres\n");
        std::exit(3);
    }

    std::vector<std::unique_ptr<Object>> objects_;
    std::vector<Object*> planes_;
    fcl::DynamicAABBTreeCollisionManagerd manager_;
    std::size_t points_ = 0;
};

}  // namespace

std::unique_ptr<NaiveDetector> make_naive(const Scene& scene) {
    return std::make_unique<Fcl>(scene);
}

}  // namespace plumb::bench
