// SPDX-License-Identifier: MIT
/// Solids of cells that are cut into tetrahedra.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include "geometry/bad_shape.h"
#include "reader/deformables/deformable_shapes.h"
#include "reader/reader.h"
#include "scene/surface_faults.h"

namespace plumb::reader {

namespace {

/// Cells of a box around a mesh, of which most are outside.
constexpr double kMostCells = 1e7;
constexpr const char* kTooManyCells =
    "the box around the mesh would have more than 10000000 cells; make \"cell\" larger";

using Cell = std::array<std::uint32_t, 3>;

/// Of a cell or a point among so many: along x first, then z, then y.
std::size_t number_of(const Cell& at, const Cell& count) {
    return at[0] + std::size_t{count[0]} * (at[2] + std::size_t{count[2]} * at[1]);
}

/// Five tetrahedra of a cell whose corners are numbered x + 2 y + 4 z, of those cells whose
/// coordinates have an even sum; the middle one comes last. Others are mirrored in x.
constexpr std::array<std::array<std::uint32_t, 4>, 5> kFive{
    {{1, 0, 5, 3}, {2, 0, 3, 6}, {4, 0, 6, 5}, {7, 3, 5, 6}, {0, 3, 6, 5}}};

/// Cells become tetrahedra, and points are numbered as they are met.
class Lattice {
public:
    using Place = std::array<std::uint32_t, 3>;  ///< in halves of a cell: corners are even

    Lattice(const Eigen::Vector3d& corner, const Eigen::Vector3d& cell, const Cell& cells)
        : corner_(corner), half_(cell / 2), cells_(cells) {}

    /// Cuts all cells that are in; is_in(cell) is asked of cells within the bounds.
    template <class IsIn>
    Elements cut(CellCut way, IsIn is_in) {
        for (std::uint32_t y = 0; y < cells_[1]; ++y)
            for (std::uint32_t z = 0; z < cells_[2]; ++z)
                for (std::uint32_t x = 0; x < cells_[0]; ++x) {
                    const Cell cell{x, y, z};
                    if (!is_in(cell)) continue;
                    if (way == CellCut::five)
                        add_five(cell);
                    else
                        add_around_centre(cell, is_in);
                }
        made_.triangles = surface_of(made_.tetrahedra);
        return std::move(made_);
    }

    std::uint32_t point(const Place& at) {
        const std::size_t key =
            number_of(at, {2 * cells_[0] + 1, 2 * cells_[1] + 1, 2 * cells_[2] + 1});
        const auto next = static_cast<std::uint32_t>(made_.points.size());
        const auto [place, is_new] = numbers_.emplace(key, next);
        if (is_new)
            made_.points.push_back(corner_ +
                                   half_.cwiseProduct(Eigen::Vector3d(at[0], at[1], at[2])));
        return place->second;
    }

private:
    void add_five(const Cell& cell) {
        const bool mirrored = (cell[0] + cell[1] + cell[2]) % 2 == 1;
        for (const auto& five : kFive) {
            std::array<std::uint32_t, 4> t;
            for (std::size_t k = 0; k < 4; ++k) {
                const std::uint32_t c = mirrored ? five[k] ^ 1u : five[k];
                t[k] = point({2 * (cell[0] + (c & 1u)), 2 * (cell[1] + (c >> 1 & 1u)),
                              2 * (cell[2] + (c >> 2))});
            }
            if (mirrored) std::swap(t[0], t[1]);
            made_.tetrahedra.push_back(t);
        }
    }

    /// Across each face that two cells share, four tetrahedra around the line from centre to
    /// centre, which the first of the two adds; across an outer one two, whose diagonal joins even
    /// corners.
    template <class IsIn>
    void add_around_centre(const Cell& cell, IsIn is_in) {
        const Place centre{2 * cell[0] + 1, 2 * cell[1] + 1, 2 * cell[2] + 1};
        const std::uint32_t own = point(centre);
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const bool forwards : {false, true}) {
                const bool has_next = forwards ? cell[axis] + 1 < cells_[axis] : cell[axis] > 0;
                Cell next = cell;
                if (has_next) next[axis] = forwards ? cell[axis] + 1 : cell[axis] - 1;
                const bool shared = has_next && is_in(next);
                if (shared && !forwards) continue;
                const std::array<Place, 4> at = corners_of_face(centre, axis, forwards);
                std::array<std::uint32_t, 4> ring;
                for (std::size_t k = 0; k < 4; ++k) ring[k] = point(at[k]);
                if (shared) {
                    Place beyond = centre;
                    beyond[axis] += 2;
                    const std::uint32_t other = point(beyond);
                    for (std::size_t k = 0; k < 4; ++k)
                        made_.tetrahedra.push_back({own, ring[k], ring[(k + 1) % 4], other});
                    continue;
                }
                const std::size_t k = (at[0][0] + at[0][1] + at[0][2]) / 2 % 2;  // 0: it is even
                made_.tetrahedra.push_back({own, ring[k], ring[k + 1], ring[k + 2]});
                made_.tetrahedra.push_back({own, ring[k], ring[k + 2], ring[(k + 3) % 4]});
            }
    }

    /// Counter-clockwise, seen from outside of the cell.
    static std::array<Place, 4> corners_of_face(const Place& centre, std::size_t axis,
                                                bool forwards) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<Place, 4> ring;
        for (std::size_t k = 0; k < 4; ++k) {
            const bool far_u = k == 1 || k == 2, far_v = k >= 2;
            ring[k][axis] = forwards ? centre[axis] + 1 : centre[axis] - 1;
            ring[k][u] = far_u ? centre[u] + 1 : centre[u] - 1;
            ring[k][v] = far_v ? centre[v] + 1 : centre[v] - 1;
        }
        if (!forwards) std::swap(ring[1], ring[3]);
        return ring;
    }

    Eigen::Vector3d corner_, half_;
    Cell cells_;
    std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
    Elements made_;
};

/// Where lines along z, one through the middle of each column of cells, cross a closed mesh.
class Crossings {
public:
    Crossings(const TriangleMesh& mesh, const Eigen::Vector3d& corner, double cell,
              const Cell& cells)
        : mesh_(mesh), corner_(corner), cell_(cell), cells_(cells) {
        columns_.resize(std::size_t{cells[0]} * cells[1]);
        for (const auto& t : mesh.triangles) add(t);
    }

    /// How often the surface winds around the middle of a cell; 0 outside.
    int winding(const Cell& cell) const {
        const double z = corner_.z() + cell_ * (cell[2] + 0.5);
        int sum = 0;
        for (const Crossing& c : columns_[cell[0] + std::size_t{cells_[0]} * cell[1]])
            if (c.z > z) sum += c.sign;
        return sum;
    }

private:
    struct Crossing {
        double z;
        int sign;  ///< 1 where the triangle faces up
    };

    Eigen::Vector2d middle(std::uint32_t x, std::uint32_t y) const {
        return corner_.head<2>() + cell_ * Eigen::Vector2d(x + 0.5, y + 0.5);
    }

    /// Twice the area of the triangle over an edge with its tip at `at`, seen from +z, and the side
    /// that `at` is on. Both triangles of an edge compute with the same numbers, so that no line
    /// slips through between them.
    double side(std::uint32_t from, std::uint32_t to, const Eigen::Vector2d& at, bool& left) const {
        const bool forward = from < to;
        const Eigen::Vector2d p = mesh_.vertices[std::min(from, to)].head<2>(),
                              q = mesh_.vertices[std::max(from, to)].head<2>();
        const double area = (q.x() - p.x()) * (at.y() - p.y()) - (q.y() - p.y()) * (at.x() - p.x());
        left = (area >= 0) == forward;
        return forward ? area : -area;
    }

    void cross(const std::array<std::uint32_t, 3>& t, const Eigen::Vector2d& at,
               std::vector<Crossing>& column) const {
        bool left[3];
        const double c = side(t[0], t[1], at, left[0]), a = side(t[1], t[2], at, left[1]),
                     b = side(t[2], t[0], at, left[2]);
        if (left[0] != left[1] || left[0] != left[2]) return;
        const double sum = a + b + c;
        const auto z = [&](std::size_t k) { return mesh_.vertices[t[k]].z(); };
        column.push_back(
            {sum != 0 ? (a * z(0) + b * z(1) + c * z(2)) / sum : z(0), left[0] ? 1 : -1});
    }

    void add(const std::array<std::uint32_t, 3>& t) {
        Eigen::Vector2d low = mesh_.vertices[t[0]].head<2>(), high = low;
        for (const std::uint32_t p : t) {
            low = low.cwiseMin(mesh_.vertices[p].head<2>());
            high = high.cwiseMax(mesh_.vertices[p].head<2>());
        }
        const auto first = [&](int axis) {
            const double at = (low[axis] - corner_[axis]) / cell_ - 0.5;
            return static_cast<std::uint32_t>(std::max(0.0, std::floor(at)));
        };
        const auto end = [&](int axis) {
            const double at = std::max(0.0, (high[axis] - corner_[axis]) / cell_ + 1.5);
            return std::min(cells_[static_cast<std::size_t>(axis)], static_cast<std::uint32_t>(at));
        };
        for (std::uint32_t y = first(1); y < end(1); ++y)
            for (std::uint32_t x = first(0); x < end(0); ++x)
                cross(t, middle(x, y), columns_[x + std::size_t{cells_[0]} * y]);
    }

    const TriangleMesh& mesh_;
    Eigen::Vector3d corner_;
    double cell_;
    Cell cells_;
    std::vector<std::vector<Crossing>> columns_;
};

/// Those whose middles the surface winds around, by their number.
std::vector<bool> cells_inside(const Crossings& crossings, const Cell& cells) {
    std::vector<bool> inside(std::size_t{cells[0]} * cells[1] * cells[2]);
    for (std::uint32_t y = 0; y < cells[1]; ++y)
        for (std::uint32_t z = 0; z < cells[2]; ++z)
            for (std::uint32_t x = 0; x < cells[0]; ++x)
                inside[number_of({x, y, z}, cells)] = crossings.winding({x, y, z}) != 0;
    return inside;
}

/// Cells that cover a size [m].
std::uint32_t cells_over(double size, double cell) {
    const double count = std::ceil(size / cell - 1e-9);
    if (!(count <= kMostCells)) throw BadShape(kTooManyCells);
    return static_cast<std::uint32_t>(std::max(1.0, count));
}

}  // namespace

Elements mesh_lattice(const TriangleMesh& mesh, double cell, CellCut cut) {
    if (const auto fault = deformable_faults::edge_fault(mesh.triangles, true))
        throw BadShape("no cells can be put into the mesh: " + fault->sentence);
    Eigen::Vector3d low = mesh.vertices.front(), high = low;
    for (const Eigen::Vector3d& p : mesh.vertices) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const Eigen::Vector3d size = high - low;
    const Cell cells{cells_over(size.x(), cell), cells_over(size.y(), cell),
                     cells_over(size.z(), cell)};
    if (static_cast<double>(cells[0]) * cells[1] * cells[2] > kMostCells)
        throw BadShape(kTooManyCells);
    const Eigen::Vector3d corner =
        (low + high) / 2 - cell / 2 * Eigen::Vector3d(cells[0], cells[1], cells[2]);
    const std::vector<bool> inside = cells_inside(Crossings(mesh, corner, cell, cells), cells);
    const auto count = std::count(inside.begin(), inside.end(), true);
    if (count == 0) throw BadShape("no cell has its centre inside the mesh; make \"cell\" smaller");
    // each has a corner of its own, and a scene has no room for more points
    if (static_cast<std::size_t>(count) > kMaxParticles)
        throw BadShape("the mesh would have more than " + std::to_string(kMaxParticles) +
                       " cells inside; make \"cell\" larger");
    return Lattice(corner, Eigen::Vector3d::Constant(cell), cells).cut(cut, [&](const Cell& at) {
        return inside[number_of(at, cells)];
    });
}

Elements box_lattice(const Eigen::Vector3d& half_extents, std::array<std::uint32_t, 3> cells,
                     CellCut cut) {
    const Eigen::Vector3d count(cells[0], cells[1], cells[2]);
    Lattice lattice(-half_extents, (2 * half_extents).cwiseQuotient(count), cells);
    for (std::uint32_t y = 0; y <= cells[1]; ++y)
        for (std::uint32_t z = 0; z <= cells[2]; ++z)
            for (std::uint32_t x = 0; x <= cells[0]; ++x) lattice.point({2 * x, 2 * y, 2 * z});
    return lattice.cut(cut, [](const Cell&) { return true; });
}

std::uint64_t box_lattice_points(std::array<std::uint64_t, 3> cells, CellCut cut) {
    const auto [x, y, z] = cells;
    const std::uint64_t corners = (x + 1) * (y + 1) * (z + 1);
    return cut == CellCut::five ? corners : corners + x * y * z;
}

std::vector<std::array<std::uint32_t, 3>> surface_of(
    const std::vector<std::array<std::uint32_t, 4>>& tetrahedra) {
    // Seen from outside, counter-clockwise: opposite to each of the four points.
    constexpr std::array<std::array<std::size_t, 3>, 4> sides{
        {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    struct Face {
        std::array<std::uint32_t, 3> key, points;
    };
    std::vector<Face> faces;
    faces.reserve(4 * tetrahedra.size());
    for (const auto& t : tetrahedra)
        for (const auto& [a, b, c] : sides) {
            Face face{{t[a], t[b], t[c]}, {t[a], t[b], t[c]}};
            std::sort(face.key.begin(), face.key.end());
            faces.push_back(face);
        }
    std::stable_sort(faces.begin(), faces.end(),
                     [](const Face& f, const Face& g) { return f.key < g.key; });
    std::vector<std::array<std::uint32_t, 3>> surface;
    for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
        while (end < faces.size() && faces[end].key == faces[i].key) ++end;
        if (end - i == 1) surface.push_back(faces[i].points);
    }
    return surface;
}

}  // namespace plumb::reader
