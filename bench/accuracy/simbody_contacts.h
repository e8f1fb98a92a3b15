// SPDX-License-Identifier: MIT
/// What may touch in a scene, as Simbody's stepper of rigid contacts has it told beforehand:
/// corners and spheres on faces, and spheres on spheres. Boxes touch if they stand on each other at
/// the start.
#pragma once

#include "accuracy/peer.h"

#include <Simbody.h>

namespace plumb::bench {

namespace st = SimTK;

inline st::Vec3 to_simbody(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline st::Transform to_simbody(const Placement& p) {
    const Quaterniond& q = p.rotation;
    return {st::Rotation(st::Quaternion(q.w(), q.x(), q.y(), q.z())), to_simbody(p.position)};
}
inline Vector3d from_simbody(const st::Vec3& v) { return {v[0], v[1], v[2]}; }

/// `bodies` [body]: the ground where it is fixed.
void add_contacts(st::SimbodyMatterSubsystem& matter, std::vector<st::MobilizedBody>& bodies,
                  const Scene& scene, const World& world);

}  // namespace plumb::bench
