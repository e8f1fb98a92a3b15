// SPDX-License-Identifier: MIT
/// A scene of planes, boxes and spheres on ODE's own dynamics (quick step), without sleeping.
#include "peer.h"

#include <ode/ode.h>

namespace {

dWorldID world;
dJointGroupID joints;
int points = 0;
double friction = 0.5;

void touch(void*, dGeomID a, dGeomID b) {
    if (!dGeomGetBody(a) && !dGeomGetBody(b)) return;
    dContact contacts[8];
    const int count = dCollide(a, b, 8, &contacts[0].geom, sizeof(dContact));
    points += count;
    for (int i = 0; i < count; ++i) {
        contacts[i].surface.mode = dContactApprox1;
        contacts[i].surface.mu = friction;
        dJointAttach(dJointCreateContact(world, joints, &contacts[i]), dGeomGetBody(a),
                     dGeomGetBody(b));
    }
}

dGeomID make_geom(dSpaceID space, const plumb::Geometry& g) {
    const Eigen::Vector3d s = 2 * g.half_extents;
    switch (g.kind) {
        case plumb::ShapeKind::plane:
            return dCreatePlane(space, 0, 1, 0, 0);
        case plumb::ShapeKind::box:
            return dCreateBox(space, s.x(), s.y(), s.z());
        case plumb::ShapeKind::sphere:
            return dCreateSphere(space, g.radius);
        default:
            std::fprintf(stderr, "this peer knows planes, boxes and spheres\n");
            std::exit(3);
    }
}

void place(dGeomID geom, const plumb::Placement& p) {
    if (dGeomGetClass(geom) == dPlaneClass) return;
    dGeomSetPosition(geom, p.position.x(), p.position.y(), p.position.z());
    const dQuaternion q = {p.rotation.w(), p.rotation.x(), p.rotation.y(), p.rotation.z()};
    dGeomSetQuaternion(geom, q);
}

void add_dynamics(dGeomID geom, const plumb::Geometry& g, const plumb::BodySpec& spec,
                  double density) {
    const dBodyID body = dBodyCreate(world);
    dMass mass;
    const Eigen::Vector3d s = 2 * g.half_extents;
    if (g.kind == plumb::ShapeKind::box)
        dMassSetBox(&mass, density, s.x(), s.y(), s.z());
    else
        dMassSetSphere(&mass, density, g.radius);
    if (spec.mass) dMassAdjust(&mass, *spec.mass);
    dBodySetMass(body, &mass);
    dGeomSetBody(geom, body);
    dBodySetLinearVel(body, spec.velocity.x(), spec.velocity.y(), spec.velocity.z());
}

}  // namespace

int main(int argc, char** argv) {
    using plumb::peer::now_ms;
    const auto [scene, iterations] = plumb::peer::arguments(argc, argv);
    dInitODE2(0);
    world = dWorldCreate();
    joints = dJointGroupCreate(0);
    const dSpaceID space = dHashSpaceCreate(nullptr);
    dHashSpaceSetLevels(space, -1, 1);
    const Eigen::Vector3d g = scene.settings.gravity;
    dWorldSetGravity(world, g.x(), g.y(), g.z());
    dWorldSetQuickStepNumIterations(world, iterations);
    dWorldSetAutoDisableFlag(world, 0);
    dWorldSetContactSurfaceLayer(world, 0.001);
    dWorldSetContactMaxCorrectingVel(world, 1);
    friction = scene.materials[scene.bodies.back().material].friction;
    for (const plumb::BodySpec& spec : scene.bodies) {
        const plumb::Geometry& shape = scene.geometries[spec.geometry];
        const dGeomID geom = make_geom(space, shape);
        if (spec.motion == plumb::Motion::dynamic)
            add_dynamics(geom, shape, spec, plumb::peer::density_of(scene, spec));
        place(geom, spec.placement);
    }

    plumb::peer::Times times;
    for (int step = 0; step < plumb::peer::kSteps; ++step) {
        points = 0;
        const double start = now_ms();
        dSpaceCollide(space, nullptr, touch);
        const double detected = now_ms();
        dWorldQuickStep(world, scene.settings.dt);
        const double solved = now_ms();
        dJointGroupEmpty(joints);
        if (step < plumb::peer::kMeasuredFrom) continue;
        times.detect.push_back(detected - start);
        times.solve.push_back(solved - detected);
        times.step.push_back(now_ms() - start);
        times.points.push_back(points);
    }
    times.print("ODE", scene, iterations);
    dCloseODE();
    return 0;
}
