// SPDX-License-Identifier: MIT
#include "geometry/hills.h"

#include "math/random.h"

namespace plumb {
namespace {

/// Random heights in [−1, 1) on a lattice that covers an area of (x, z) about the origin.
class Lattice {
public:
    Lattice(double extent_x, double extent_z, double wavelength, Random& random)
        : wavelength_(wavelength),
          columns_(static_cast<std::size_t>(extent_x / wavelength) + 3),
          low_x_(-extent_x / 2),
          low_z_(-extent_z / 2) {
        const std::size_t rows = static_cast<std::size_t>(extent_z / wavelength) + 3;
        heights_.reserve(rows * columns_);
        for (std::size_t i = 0; i < rows * columns_; ++i) heights_.push_back(random.between(-1, 1));
    }

    double at(double x, double z) const {
        const double u = (x - low_x_) / wavelength_, v = (z - low_z_) / wavelength_;
        const auto column = static_cast<std::size_t>(u), row = static_cast<std::size_t>(v);
        const double s = blend(u - static_cast<double>(column));
        const double t = blend(v - static_cast<double>(row));
        const double* h = heights_.data() + row * columns_ + column;
        const double* next = h + columns_;
        return (1 - t) * ((1 - s) * h[0] + s * h[1]) + t * ((1 - s) * next[0] + s * next[1]);
    }

private:
    /// From 0 to 1 with neither slope nor curvature at the ends.
    static double blend(double t) { return t * t * t * (t * (6 * t - 15) + 10); }

    double wavelength_;
    std::size_t columns_;
    double low_x_, low_z_;
    std::vector<double> heights_;  // row after row
};

}  // namespace

std::vector<double> heights_of(const Hills& hills, std::uint32_t rows, std::uint32_t columns,
                               double spacing_x, double spacing_z) {
    std::vector<double> heights(std::size_t{rows} * columns, 0);
    const double extent_x = (columns - 1) * spacing_x, extent_z = (rows - 1) * spacing_z;
    Random random(hills.seed);
    double amplitude = hills.amplitude, wavelength = hills.wavelength;
    for (std::uint32_t i = 0; i < hills.octaves; ++i, amplitude /= 2, wavelength /= 2) {
        const Lattice lattice(extent_x, extent_z, wavelength, random);
        for (std::uint32_t row = 0; row < rows; ++row)
            for (std::uint32_t column = 0; column < columns; ++column)
                heights[std::size_t{row} * columns + column] +=
                    amplitude *
                    lattice.at(column * spacing_x - extent_x / 2, row * spacing_z - extent_z / 2);
    }
    return heights;
}

Geometry mesh_of_height_field(const Geometry& field) {
    Geometry mesh;
    mesh.kind = ShapeKind::mesh;
    for (std::uint32_t row = 0; row < field.rows; ++row)
        for (std::uint32_t column = 0; column < field.columns; ++column)
            mesh.vertices.emplace_back((column - 0.5 * (field.columns - 1)) * field.spacing_x,
                                       field.heights[std::size_t{row} * field.columns + column],
                                       (row - 0.5 * (field.rows - 1)) * field.spacing_z);
    for (std::uint32_t row = 0; row + 1 < field.rows; ++row)
        for (std::uint32_t column = 0; column + 1 < field.columns; ++column) {
            const std::uint32_t a = row * field.columns + column, b = a + field.columns;
            mesh.triangles.push_back({a, b, a + 1});
            mesh.triangles.push_back({a + 1, b, b + 1});
        }
    return mesh;
}

}  // namespace plumb
