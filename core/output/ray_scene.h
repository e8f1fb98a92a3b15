// SPDX-License-Identifier: MIT
/// The bodies and deformables of a frame as something that rays can be cast at (Embree).
///
/// Places are relative to `middle`, so that single precision suffices far from the world's origin.
#pragma once

#include "measure/frame.h"
#include "output/recording.h"
#include "output/smooth_surface.h"

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace plumb {

/// What is drawn: one of the bodies, the deformables, or the links.
struct Drawn {
    enum class Kind { body, deformable, link } kind;
    std::uint32_t index;
};

/// Where a ray met something.
struct RaySurface {
    float distance;          ///< [m]
    Eigen::Vector3f point;   ///< relative to middle [m]
    Eigen::Vector3f start;   ///< of rays that leave from there [m]
    Eigen::Vector3f normal;  ///< unit, towards where the ray came from
    Drawn drawn;
    const Geometry* geometry = nullptr;                     ///< of a body
    Eigen::Vector3f point_local = Eigen::Vector3f::Zero();  ///< in the frame of the shape [m]
};

class RayScene {
public:
    /// `reach`: how far planes are drawn [m]; `thinnest`: radius that ropes and links have at the
    /// least, so that they are seen [m]. Header and frame are read here, and the header's
    /// geometries later too.
    RayScene(const RecordingHeader& header, const Frame& frame, const Eigen::Vector3d& middle,
             double reach, double thinnest);

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

    /// What one geometry of the scene shows: a shape, a surface or, where it has neither, lines.
    struct Item {
        Drawn drawn;
        const Geometry* geometry = nullptr;
        Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
        Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< relative to middle [m]
        std::optional<SmoothSurface> surface = std::nullopt;
    };
    /// The ends of a piece of rope, relative to middle [m].
    using Piece = std::array<Eigen::Vector3f, 2>;

    void add_bodies(const RecordingHeader& header, const Frame& frame);
    void add_deformables(const RecordingHeader& header, const Frame& frame, double thinnest);
    void add_links(const RecordingHeader& header, const Frame& frame, double thinnest);
    void add(const Geometry& geometry, const Placement& placement, std::uint32_t body);
    void add(Item item, RTCGeometry geometry);
    RTCScene form(const Geometry& geometry);
    RTCGeometry pieces(const std::vector<Piece>& pieces, double radius);
    RaySurface surface(const RTCRayHit& hit, const Eigen::Vector3f& from,
                       const Eigen::Vector3f& direction) const;

    Eigen::Vector3d middle_;
    double reach_;
    Device device_;
    Scene scene_;
    std::map<const Geometry*, Scene> forms_;
    std::vector<Item> items_;  ///< [geometry of the scene]
};

}  // namespace plumb
