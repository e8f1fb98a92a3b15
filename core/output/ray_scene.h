// SPDX-License-Identifier: MIT
/// The bodies of a frame as something that rays can be cast at (Embree).
///
/// Places are relative to `middle`, so that single precision suffices far from the world's origin.
#pragma once

#include "measure/frame.h"
#include "output/recording.h"

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace plumb {

/// Where a ray met a body.
struct RaySurface {
    float distance;               ///< [m]
    Eigen::Vector3f point;        ///< relative to middle [m]
    Eigen::Vector3f normal;       ///< unit, towards where the ray came from
    Eigen::Vector3f point_local;  ///< in the frame of the shape [m]
    const Geometry* geometry;
    std::uint32_t body;
};

class RayScene {
public:
    /// `reach`: how far planes are drawn [m]. Header and frame are read here, and the header's
    /// geometries later too.
    RayScene(const RecordingHeader& header, const Frame& frame, const Eigen::Vector3d& middle,
             double reach);

    std::optional<RaySurface> nearest(const Eigen::Vector3f& from,
                                      const Eigen::Vector3f& direction) const;
    bool blocked(const Eigen::Vector3f& from, const Eigen::Vector3f& direction) const;

private:
    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };
    using Device = std::unique_ptr<RTCDeviceTy, Release>;
    using Scene = std::unique_ptr<RTCSceneTy, Release>;

    /// What one instance shows.
    struct Item {
        const Geometry* geometry;
        std::uint32_t body;
        Eigen::Matrix3f rotation;
        Eigen::Vector3f position;  ///< relative to middle [m]
    };

    void add(const Geometry& geometry, const Placement& placement, std::uint32_t body);
    RTCScene form(const Geometry& geometry);

    Eigen::Vector3d middle_;
    double reach_;
    Device device_;
    Scene scene_;
    std::map<const Geometry*, Scene> forms_;
    std::vector<Item> items_;  ///< [instance]
};

}  // namespace plumb
