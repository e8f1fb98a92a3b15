// SPDX-License-Identifier: MIT
/// Points and elements of deformables, each shape about the origin of its own frame.
///
/// Triangles run counter-clockwise seen from outside, or from above where there is no outside.
/// Tetrahedra run counter-clockwise in their first three points, seen from the fourth.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "reader/meshes/obj.h"

namespace plumb::reader {

struct Elements {
    std::vector<Eigen::Vector3d> points;                   ///< [m]
    std::vector<std::array<std::uint32_t, 2>> segments;    ///< of a line
    std::vector<std::array<std::uint32_t, 3>> triangles;   ///< of a surface, a solid's too
    std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< of a solid
};

/// A rectangle in the plane of x and z, seen from +y; points run along x first. Diagonals
/// alternate.
Elements grid_surface(std::array<std::uint32_t, 2> cells, const Eigen::Vector2d& size);

/// A straight line of equal segments.
Elements straight_line(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                       std::uint32_t segments);

/// An icosahedron, each edge in so many `cells`, blown up to a sphere.
Elements ball_surface(double radius, std::uint32_t cells);

/// Tetrahedra between such spheres: one of 1 cell, one of 2, and so on outwards.
Elements ball_solid(double radius, std::uint32_t cells);

/// A tube about y, with so many cells around and along it; points run around it first, from the
/// lower end. `closed`: with a flat lid of about equal triangles at each end.
Elements tube_surface(double radius, double length, std::array<std::uint32_t, 2> cells,
                      bool closed);

/// How cells become tetrahedra: each by itself into five, with those of its neighbours mirrored, or
/// around its centre, in a body-centred lattice. That has about twice as many points and up to two
/// and a half times as many tetrahedra, and 0.6 of the error of bending, where it is more than one
/// cell thick.
enum class CellCut : std::uint8_t { five, body_centered };

/// A box of cells. Their corners come first and run along x first, then z, then y; centres of cells
/// follow.
Elements box_lattice(const Eigen::Vector3d& half_extents, std::array<std::uint32_t, 3> cells,
                     CellCut cut = CellCut::five);

/// The same of those cells, cubes with edges of `cell`, whose centres lie inside a closed mesh.
/// Throws BadShape where there is none, where the mesh is open, or where there are too many cells.
Elements mesh_lattice(const TriangleMesh& mesh, double cell, CellCut cut = CellCut::five);

/// The faces that belong to one tetrahedron alone, counter-clockwise seen from outside.
std::vector<std::array<std::uint32_t, 3>> surface_of(
    const std::vector<std::array<std::uint32_t, 4>>& tetrahedra);

/// How many points the shapes above have.
std::uint64_t ball_surface_points(std::uint64_t cells);
std::uint64_t ball_solid_points(std::uint64_t cells);
std::uint64_t box_lattice_points(std::array<std::uint64_t, 3> cells, CellCut cut);

}  // namespace plumb::reader
