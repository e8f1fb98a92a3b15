// SPDX-License-Identifier: MIT
/// What a deformable and a link need to be drawn.
#pragma once

#include "measure/frame.h"
#include "scene/scene.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace plumb {

struct RecordedDeformable {
    std::string name;
    DeformableKind kind = DeformableKind::cloth;
    std::uint32_t index = 0;                              ///< of Scene::deformables
    std::uint32_t first = 0, count = 0;                   ///< of Frame::particles
    std::vector<std::array<std::uint32_t, 2>> segments;   ///< of a rope, by points of it
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of all others: the surface
    double thickness = 0;                                 ///< of cloth; a rope's diameter [m]
    double radius = 0;                                    ///< of the particles [m]
    bool tears = false;
    std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< of a solid that tears
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

/// How many elements there are that may tear: segments, triangles or tetrahedra.
std::size_t element_count(const RecordedDeformable& deformable);

/// The segments, and the triangles of the surface, that are not torn in a frame.
std::vector<std::array<std::uint32_t, 2>> segments_in(const RecordedDeformable& deformable,
                                                      const Frame& frame);
std::vector<std::array<std::uint32_t, 3>> triangles_in(const RecordedDeformable& deformable,
                                                       const Frame& frame);

/// Where a point of a link is in a frame, which has the header's bodies and particles.
Eigen::Vector3d place_of(const RecordedPoint& point, const Frame& frame);

}  // namespace plumb
