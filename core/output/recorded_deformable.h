// SPDX-License-Identifier: MIT
/// What a deformable and a link need to be drawn.
#pragma once

#include "measure/frame.h"
#include "scene/scene.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace plumb {

struct RecordedDeformable {
    std::string name;
    DeformableKind kind = DeformableKind::cloth;
    std::uint32_t first = 0, count = 0;                   ///< of Frame::particles
    std::vector<std::array<std::uint32_t, 2>> segments;   ///< of a rope, by points of it
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of all others: the surface
    double thickness = 0;                                 ///< of cloth; a rope's diameter [m]
    double radius = 0;                                    ///< of the particles [m]
    double tearing_strain = std::numeric_limits<double>::infinity();
    std::vector<Eigen::Vector3d> rest;  ///< the points at the start, where it can tear [m]
    double size = 0;          ///< longest side of the box about the points at the start [m]
    std::uint32_t color = 0;  ///< 0xRRGGBB, 0 = chosen by the viewer
};

/// A particle, or a place in the frame of a body or of the world.
struct RecordedPoint {
    std::uint32_t particle = kNoIndex;                ///< index into Frame::particles
    std::uint32_t body = kNoIndex;                    ///< index into Frame::bodies
    Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< unless it is a particle [m]
};

struct RecordedLink {
    RecordedPoint a, b;
};

std::vector<RecordedDeformable> recorded_deformables(const Scene& scene);
std::vector<RecordedLink> recorded_links(const Scene& scene);

/// How many particles the deformables have together.
std::size_t particle_count(const std::vector<RecordedDeformable>& deformables);

/// Radius of a rope as it is drawn [m].
inline double rope_radius(const RecordedDeformable& rope) {
    return rope.thickness > 0 ? 0.5 * rope.thickness : rope.radius;
}

/// Whether a segment or a triangle has an edge that is stretched so far that it must have torn.
bool is_torn(const RecordedDeformable& deformable, std::span<const std::uint32_t> element,
             const Frame& frame);

/// Where a point of a link is in a frame, which has the header's bodies and particles.
Eigen::Vector3d place_of(const RecordedPoint& point, const Frame& frame);

}  // namespace plumb
