// SPDX-License-Identifier: MIT
/// One body of the table: from what the user wrote, checked, to a row of all its columns.
#pragma once

#include "world/bodies.h"

#include <string>

namespace plumb {

/// What a row begins with. By default that of a vacant slot.
struct BodyRow {
    std::uint32_t id = kNoIndex;
    Motion motion = Motion::fixed;
    Vector3d position = Vector3d::Zero();  ///< [m]
    Quaterniond orientation = Quaterniond::Identity();
    Vector3d velocity = Vector3d::Zero();          ///< [m/s]
    Vector3d angular_velocity = Vector3d::Zero();  ///< [rad/s]
    double mass = 0;                               ///< [kg]
    Vector3d inertia = Vector3d::Zero();           ///< [kg m²]
    Vector3d force = Vector3d::Zero();             ///< [N]
    Vector3d torque = Vector3d::Zero();            ///< [N m]
    Placement geometry_in_body;
    std::uint32_t geometry = kNoIndex;
    double bounding_radius = 0;  ///< about the centre of mass [m]
    std::uint32_t material = 0, group = 0, mask = 0;
    MotionScript script;
};

/// Makes the row of a body; `assets` has its geometry and material. Throws SceneError, with
/// `pointer` as the body's place, for what cannot be simulated.
BodyRow make_body(const Scene& assets, const BodySpec& spec, const std::string& pointer);

/// Makes the table `count` rows long. Those that come are vacant.
void resize_bodies(Bodies& bodies, std::size_t count);

/// Replaces a row.
void put_body(Bodies& bodies, std::size_t slot, const BodyRow& row);

}  // namespace plumb
