// SPDX-License-Identifier: MIT
/// ODE: hash space and dCollide.
#include "detection/naive.h"

#include <ode/ode.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace plumb::bench {

const char* const kPlugin = "ode";

namespace {

class Ode final : public NaiveDetector {
public:
    explicit Ode(const Scene& scene) {
        dInitODE2(0);
        dAllocateODEDataForThread(dAllocateMaskAll);
        space_ = dHashSpaceCreate(nullptr);
        dHashSpaceSetLevels(space_, -1, 1);
        for (const BodySpec& body : scene.bodies) {
            const bool dynamic = body.motion == Motion::dynamic;
            geoms_.push_back(make(scene.geometries[body.geometry]));
            // What does not move only meets what does.
            dGeomSetCategoryBits(geoms_.back(), dynamic ? 1 : 2);
            dGeomSetCollideBits(geoms_.back(), dynamic ? 3 : 1);
        }
    }

    void move(std::size_t i, const Placement& p) override {
        if (dGeomGetClass(geoms_[i]) == dPlaneClass) return;
        dGeomSetPosition(geoms_[i], p.position.x(), p.position.y(), p.position.z());
        const dQuaternion q = {p.rotation.w(), p.rotation.x(), p.rotation.y(), p.rotation.z()};
        dGeomSetQuaternion(geoms_[i], q);
    }

    std::size_t detect() override {
        points_ = 0;
        dSpaceCollide(space_, this, [](void* self, dGeomID a, dGeomID b) {
            dContactGeom contacts[8];
            static_cast<Ode*>(self)->points_ +=
                static_cast<std::size_t>(dCollide(a, b, 8, contacts, sizeof(dContactGeom)));
        });
        return points_;
    }

private:
    dGeomID make(const Geometry& g) const {
        const Eigen::Vector3d s = 2 * g.half_extents;
        if (g.kind == ShapeKind::plane) return dCreatePlane(space_, 0, 1, 0, 0);
        if (g.kind == ShapeKind::box) return dCreateBox(space_, s.x(), s.y(), s.z());
        if (g.kind == ShapeKind::sphere) return dCreateSphere(space_, g.radius);
        std::fprintf(stderr, "this bench knows planes, boxes and spheres\n");
        std::exit(3);
    }

    dSpaceID space_;
    std::vector<dGeomID> geoms_;
    std::size_t points_ = 0;
};

}  // namespace

std::unique_ptr<NaiveDetector> make_naive(const Scene& scene) {
    return std::make_unique<Ode>(scene);
}

}  // namespace plumb::bench
