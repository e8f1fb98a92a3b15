// SPDX-License-Identifier: MIT
/// What the HTML replay carries of deformables and links.
#pragma once

#include "output/particle_motion.h"
#include "output/recording.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace plumb {

/// What each deformable looks like and how its places are to be read. Triangles go to the meshes,
/// each corner a uint32. Of what tears in the `frames`, each segment or triangle has the first
/// frame that shows it and the one after the last.
nlohmann::json deformables_json(const RecordingHeader& header, const std::vector<Frame>& frames,
                                const std::vector<ParticleGrid>& grids, std::string& meshes);

/// Their two ends each: a particle, or a place on a body or in the world.
nlohmann::json links_json(const RecordingHeader& header);

}  // namespace plumb
