// SPDX-License-Identifier: MIT
/// What the HTML replay carries, made of a recording: a JSON text, meshes and the motion. The
/// player reads the same.
#pragma once

#include "output/motion_code.h"
#include "output/particle_motion.h"
#include "output/recording.h"
#include "output/view.h"

#include <string>
#include <vector>

namespace plumb {

struct ReplayParts {
    std::string scene;      ///< JSON; no "<" in it, so that no string can end the script element
    std::string meshes;     ///< for each mesh float32 vertices, then uint32 corners of triangles
    std::string motion;     ///< encode_motion of the bodies that move
    std::string particles;  ///< encode_particles of the deformables
};

/// How everything moves.
struct ReplayMotions {
    std::vector<std::vector<PoseSample>> bodies;  ///< [body][frame]
    std::vector<ParticleMotion> deformables;
};

/// `notes`: the frames without their bodies and particles; `balls`: what the view shall hold.
ReplayParts replay_parts(const RecordingHeader& header, const std::vector<Frame>& notes,
                         const ReplayMotions& motions, const std::vector<Ball>& balls);

struct ShapeTexts {
    std::string shapes;  ///< JSON: an array, null where there was no geometry; no "<" in it
    std::string meshes;  ///< as in ReplayParts
};

/// Shapes alone, for pages that draw some of them.
ShapeTexts shape_texts(const std::vector<const Geometry*>& geometries);

}  // namespace plumb
