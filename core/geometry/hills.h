// SPDX-License-Identifier: MIT
/// Height fields: heights that a rule makes, and their surface as triangles.
#pragma once

#include "scene/geometry.h"

#include <cstdint>
#include <vector>

namespace plumb {

/// Hills and hollows: random heights on a square lattice, blended smoothly between its points. Each
/// further octave has half the wavelength and half the amplitude.
struct Hills {
    double amplitude = 1;   ///< greatest height of the first octave, up and down [m]
    double wavelength = 4;  ///< distance between the points of the first octave's lattice [m]
    std::uint32_t octaves = 1;
    std::uint64_t seed = 1;
};

/// Heights of hills over a grid, row after row along z [m]; the same on every machine.
std::vector<double> heights_of(const Hills& hills, std::uint32_t rows, std::uint32_t columns,
                               double spacing_x, double spacing_z);

/// The surface of a height field as triangles, counter-clockwise from above; each cell is cut from
/// its corner of low x and high z to the one across.
Geometry mesh_of_height_field(const Geometry& field);

}  // namespace plumb
