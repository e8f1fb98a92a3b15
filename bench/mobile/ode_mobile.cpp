// SPDX-License-Identifier: MIT
#include "mobile/contestants.h"

#include <ode/ode.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace plumb::bench {
namespace {

/// A world of ODE with the bodies and ball joints of a scene.
class OdeMobile {
public:
    OdeMobile(const Scene& scene, int iterations) : dt_(scene.settings.dt), world_(dWorldCreate()) {
        const Eigen::Vector3d& g = scene.settings.gravity;
        dWorldSetGravity(world_, g.x(), g.y(), g.z());
        dWorldSetQuickStepNumIterations(world_, iterations);
        dWorldSetAutoDisableFlag(world_, 0);
        for (const BodySpec& spec : scene.bodies) add_body(scene, spec);
        for (const JointSpec& spec : scene.joints) add_joint(spec);
    }
    ~OdeMobile() { dWorldDestroy(world_); }
    OdeMobile(const OdeMobile&) = delete;
    OdeMobile& operator=(const OdeMobile&) = delete;

    void step() { dWorldQuickStep(world_, dt_); }

    double gap() const {
        double widest = 0;
        for (const dJointID joint : joints_) {
            dVector3 a, b;
            dJointGetBallAnchor(joint, a);
            dJointGetBallAnchor2(joint, b);
            widest = std::max(widest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
        }
        return widest;
    }

private:
    void add_body(const Scene& scene, const BodySpec& spec) {
        const dBodyID body = dBodyCreate(world_);
        const Eigen::Vector3d side = 2 * scene.geometries[spec.geometry].half_extents;
        dMass mass;
        dMassSetBox(&mass, scene.materials[spec.material].density, side.x(), side.y(), side.z());
        dBodySetMass(body, &mass);
        const Eigen::Vector3d& x = spec.placement.position;
        const Eigen::Quaterniond& q = spec.placement.rotation;
        const dQuaternion rotation = {q.w(), q.x(), q.y(), q.z()};
        dBodySetPosition(body, x.x(), x.y(), x.z());
        dBodySetQuaternion(body, rotation);
        const Eigen::Vector3d& w = spec.angular_velocity;
        dBodySetAngularVel(body, w.x(), w.y(), w.z());
        bodies_.push_back(body);
    }
    void add_joint(const JointSpec& spec) {
        const dJointID joint = dJointCreateBall(world_, nullptr);
        dJointAttach(joint, bodies_[spec.body_a],
                     spec.body_b == kNoIndex ? nullptr : bodies_[spec.body_b]);
        dJointSetBallAnchor(joint, spec.anchor.x(), spec.anchor.y(), spec.anchor.z());
        joints_.push_back(joint);
    }

    double dt_;
    dWorldID world_;
    std::vector<dBodyID> bodies_;
    std::vector<dJointID> joints_;
};

}  // namespace

Contestant ode_mobile(const Scene& scene, int iterations) {
    const auto ode = std::make_shared<OdeMobile>(scene, iterations);
    return {"ODE quick " + std::to_string(iterations) + " iterations", [ode] { ode->step(); },
            [ode] { return ode->gap(); }};
}

}  // namespace plumb::bench
