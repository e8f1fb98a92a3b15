// SPDX-License-Identifier: MIT
/// A picture of one frame by casting rays, without a display: sun with soft shadows, light from the
/// sky, and what bodies throw onto each other. The same input gives the same picture.
#pragma once

#include "measure/frame.h"
#include "output/recording.h"

#include <cstdint>
#include <vector>

namespace plumb {

struct PictureSettings {
    int width = 1280, height = 720;  ///< [pixels]
    int samples = 20;                ///< rays through a pixel
    unsigned threads = 0;            ///< 0: as many as the machine runs at once
};

struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;  ///< sRGB, [height × width × 3], from the top
};

/// From the header's view, or else from one that is fitted to the bodies.
Picture draw_picture(const RecordingHeader& header, const Frame& frame,
                     const PictureSettings& settings = {});

}  // namespace plumb
