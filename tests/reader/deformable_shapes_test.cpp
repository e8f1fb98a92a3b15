// SPDX-License-Identifier: MIT
/// Shapes of deformables against the formulas of their areas and volumes.
#include "reader/deformables/deformable_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/bad_shape.h"
#include "scene/deformable_faults.h"

namespace plumb::test {

namespace {

using reader::Elements;
using std::numbers::pi;

/// What a deformable of such elements would have wrong, "" where nothing is.
std::string fault_of(const Elements& made, DeformableKind kind) {
    DeformableSpec spec;
    spec.kind = kind;
    spec.points = made.points;
    spec.segments = made.segments;
    spec.triangles = made.triangles;
    spec.tetrahedra = made.tetrahedra;
    const auto fault = deformable_fault(spec, 1);
    return fault ? fault->place + ": " + fault->sentence : "";
}

double area_of(const Elements& made) {
    double area = 0;
    for (const auto& [a, b, c] : made.triangles)
        area += (made.points[b] - made.points[a]).cross(made.points[c] - made.points[a]).norm() / 2;
    return area;
}

double volume_within(const Elements& made) {
    return deformable_faults::enclosed_volume(made.points, made.triangles);
}

double volume_of_tetrahedra(const Elements& made) {
    const auto& p = made.points;
    double volume = 0;
    for (const auto& t : made.tetrahedra)
        volume += (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).dot(p[t[3]] - p[t[0]]) / 6;
    return volume;
}

/// How far a tetrahedron is from flat: 1 of a regular one.
double worst_quality(const Elements& made) {
    double worst = 1;
    for (const auto& t : made.tetrahedra) {
        double longest = 0;
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < i; ++j)
                longest = std::max(longest, (made.points[t[i]] - made.points[t[j]]).norm());
        Elements one{made.points, {}, {}, {t}};
        worst = std::min(
            worst, volume_of_tetrahedra(one) * 6 * std::sqrt(2.0) / (longest * longest * longest));
    }
    return worst;
}

double smallest_angle(const Elements& made) {
    double least = pi;
    for (const auto& t : made.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const Eigen::Vector3d u = made.points[t[(k + 1) % 3]] - made.points[t[k]],
                                  v = made.points[t[(k + 2) % 3]] - made.points[t[k]];
            least = std::min(least, std::acos(u.normalized().dot(v.normalized())));
        }
    return least * 180 / pi;
}

reader::TriangleMesh mesh_of(const Elements& surface) {
    return {"mesh", surface.points, surface.triangles};
}

}  // namespace

TEST(DeformableShapes, GridLiesFlatAndFacesUp) {
    for (const std::array<std::uint32_t, 2> cells : {std::array{1u, 1u}, {5u, 2u}, {8u, 8u}}) {
        const Elements grid = reader::grid_surface(cells, {3, 2});
        EXPECT_EQ(fault_of(grid, DeformableKind::cloth), "");
        EXPECT_EQ(grid.points.size(), (cells[0] + 1) * (cells[1] + 1));
        EXPECT_EQ(grid.triangles.size(), 2 * cells[0] * cells[1]);
        EXPECT_NEAR(area_of(grid), 6, 1e-12);
        for (const auto& [a, b, c] : grid.triangles)
            EXPECT_GT((grid.points[b] - grid.points[a]).cross(grid.points[c] - grid.points[a]).y(),
                      0);
        EXPECT_EQ(grid.points.front(), Eigen::Vector3d(-1.5, 0, -1));
        EXPECT_EQ(grid.points[cells[0]], Eigen::Vector3d(1.5, 0, -1));
        EXPECT_EQ(grid.points.back(), Eigen::Vector3d(1.5, 0, 1));
    }
}

TEST(DeformableShapes, LineRunsFromEndToEnd) {
    const Elements line = reader::straight_line({1, 2, 3}, {1, -2, 6}, 7);
    EXPECT_EQ(fault_of(line, DeformableKind::rope), "");
    ASSERT_EQ(line.points.size(), 8u);
    EXPECT_EQ(line.points.front(), Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(line.points.back(), Eigen::Vector3d(1, -2, 6));
    for (const auto& [a, b] : line.segments)
        EXPECT_NEAR((line.points[a] - line.points[b]).norm(), 5 / 7., 1e-12);
}

TEST(DeformableShapes, BallsSurfaceComesToASpheres) {
    double error_before = 0;
    for (const std::uint32_t cells : {1u, 2u, 4u, 8u, 16u}) {
        const Elements ball = reader::ball_surface(0.5, cells);
        EXPECT_EQ(fault_of(ball, DeformableKind::balloon), "");
        EXPECT_EQ(ball.points.size(), reader::ball_surface_points(cells));
        EXPECT_EQ(ball.triangles.size(), 20 * cells * cells);
        for (const Eigen::Vector3d& p : ball.points) EXPECT_NEAR(p.norm(), 0.5, 1e-12);
        EXPECT_GT(smallest_angle(ball), 45);

        const double error = 4 * pi / 3 * 0.125 - volume_within(ball);
        EXPECT_GT(error, 0);
        if (cells > 4) {
            EXPECT_NEAR(error_before / error, 4, 0.2);  // of second order
        }
        error_before = error;
    }
    EXPECT_NEAR(area_of(reader::ball_surface(0.5, 32)), pi, 0.004);
}

TEST(DeformableShapes, BallOfTetrahedraIsFullAndHasTheSpheresSurface) {
    for (const std::uint32_t cells : {1u, 2u, 3u, 6u}) {
        const Elements ball = reader::ball_solid(2, cells);
        EXPECT_EQ(fault_of(ball, DeformableKind::solid), "");
        EXPECT_EQ(ball.points.size(), reader::ball_solid_points(cells));
        EXPECT_EQ(ball.tetrahedra.size(), 20 * cells * cells * cells);
        EXPECT_EQ(ball.triangles.size(), 20 * cells * cells);
        EXPECT_FALSE(deformable_faults::edge_fault(ball.triangles, true));
        EXPECT_NEAR(volume_of_tetrahedra(ball), volume_within(reader::ball_surface(2, cells)),
                    1e-12);
        EXPECT_NEAR(volume_of_tetrahedra(ball), volume_within(ball), 1e-12);
        EXPECT_GT(worst_quality(ball), 0.28);
    }
}

TEST(DeformableShapes, TubeIsOpenOrClosed) {
    const Elements open = reader::tube_surface(0.5, 3, {64, 10}, false);
    EXPECT_EQ(fault_of(open, DeformableKind::cloth), "");
    EXPECT_NE(fault_of(open, DeformableKind::balloon), "");
    EXPECT_NEAR(area_of(open), 3 * 64 * 2 * 0.5 * std::sin(pi / 64), 1e-12);
    for (const auto& [a, b, c] : open.triangles) {
        const Eigen::Vector3d normal =
            (open.points[b] - open.points[a]).cross(open.points[c] - open.points[a]);
        EXPECT_GT(normal.x() * open.points[a].x() + normal.z() * open.points[a].z(), 0);
    }
    for (const std::uint32_t around : {3u, 4u, 9u, 10u, 24u, 64u, 101u}) {
        const Elements tube = reader::tube_surface(0.5, 3, {around, 10}, true);
        EXPECT_EQ(fault_of(tube, DeformableKind::balloon), "") << around;
        const double polygon = around / 2. * 0.25 * std::sin(2 * pi / around);
        EXPECT_NEAR(volume_within(tube), 3 * polygon, 1e-12) << around;
        EXPECT_LE(static_cast<double>(tube.points.size()), around * 11. + around * around / 6. + 4);
    }
}

TEST(DeformableShapes, TubesTrianglesAreWellShaped) {
    for (const std::uint32_t around : {12u, 24u, 64u, 101u})
        EXPECT_GT(smallest_angle(reader::tube_surface(0.5, 2 * pi / around, {around, 2}, true)), 20)
            << around;
}

TEST(DeformableShapes, BoxOfCellsIsFull) {
    for (const std::array<std::uint32_t, 3> cells : {std::array{1u, 1u, 1u}, {2u, 3u, 4u}}) {
        const Elements box = reader::box_lattice({0.5, 1, 1.5}, cells);
        const auto [nx, ny, nz] = cells;
        EXPECT_EQ(fault_of(box, DeformableKind::solid), "");
        EXPECT_EQ(box.points.size(), (nx + 1) * (ny + 1) * (nz + 1));
        EXPECT_EQ(box.tetrahedra.size(), 5 * nx * ny * nz);
        EXPECT_EQ(box.triangles.size(), 4 * (nx * ny + ny * nz + nz * nx));
        EXPECT_FALSE(deformable_faults::edge_fault(box.triangles, true));
        EXPECT_NEAR(volume_of_tetrahedra(box), 6, 1e-12);
        EXPECT_NEAR(volume_within(box), 6, 1e-12);
        EXPECT_NEAR(area_of(box), 2 * (2 + 6 + 3), 1e-12);
        EXPECT_EQ(box.points.front(), Eigen::Vector3d(-0.5, -1, -1.5));
        EXPECT_EQ(box.points[nx], Eigen::Vector3d(0.5, -1, -1.5));
        EXPECT_EQ(box.points.back(), Eigen::Vector3d(0.5, 1, 1.5));
    }
}

TEST(DeformableShapes, ABodyCentredBoxIsFull) {
    using enum reader::CellCut;
    for (const std::array<std::uint32_t, 3> cells : {std::array{1u, 1u, 1u}, {2u, 3u, 4u}}) {
        const Elements box = reader::box_lattice({0.5, 1, 1.5}, cells, body_centered);
        const auto [nx, ny, nz] = cells;
        const std::uint32_t outer = 2 * (nx * ny + ny * nz + nz * nx), all = nx * ny * nz,
                            corners = (nx + 1) * (ny + 1) * (nz + 1);
        EXPECT_EQ(fault_of(box, DeformableKind::solid), "");
        EXPECT_EQ(box.points.size(), corners + all);
        EXPECT_EQ(box.points.size(), reader::box_lattice_points({nx, ny, nz}, body_centered));
        EXPECT_EQ(reader::box_lattice({0.5, 1, 1.5}, cells).points.size(),
                  reader::box_lattice_points({nx, ny, nz}, five));
        // four around the line through each inner face, two on each outer one
        EXPECT_EQ(box.tetrahedra.size(), 4 * (6 * all - outer) / 2 + 2 * outer);
        EXPECT_EQ(box.triangles.size(), 2 * outer);
        EXPECT_FALSE(deformable_faults::edge_fault(box.triangles, true));
        for (const auto& [a, b, c, d] : box.tetrahedra) {
            const Eigen::Vector3d& o = box.points[a];
            EXPECT_GT((box.points[b] - o).cross(box.points[c] - o).dot(box.points[d] - o), 0);
        }
        EXPECT_NEAR(volume_of_tetrahedra(box), 6, 1e-12);
        EXPECT_NEAR(volume_within(box), 6, 1e-12);
        EXPECT_NEAR(area_of(box), 2 * (2 + 6 + 3), 1e-12);
        EXPECT_EQ(box.points[nx], Eigen::Vector3d(0.5, -1, -1.5));
        EXPECT_EQ(box.points[corners - 1], Eigen::Vector3d(0.5, 1, 1.5));
    }
}

TEST(DeformableShapes, BodyCentredCellsFillAMesh) {
    const reader::TriangleMesh mesh = mesh_of(reader::ball_surface(1, 24));
    const Elements five = reader::mesh_lattice(mesh, 0.2),
                   centred = reader::mesh_lattice(mesh, 0.2, reader::CellCut::body_centered);
    EXPECT_EQ(fault_of(centred, DeformableKind::solid), "");
    EXPECT_NEAR(volume_of_tetrahedra(centred), volume_of_tetrahedra(five), 1e-12);
    EXPECT_NEAR(volume_within(centred), volume_within(five), 1e-12);
    EXPECT_EQ(centred.triangles.size(), five.triangles.size());
}

TEST(DeformableShapes, CellsFillAMesh) {
    // A box whose edges are whole numbers of cells, and whose faces meet the middles of none.
    const Elements box = reader::box_lattice({0.3, 0.2, 0.5}, {1, 1, 1});
    const Elements cells = reader::mesh_lattice(mesh_of(box), 0.1);
    EXPECT_EQ(fault_of(cells, DeformableKind::solid), "");
    EXPECT_EQ(cells.tetrahedra.size(), 5u * 6 * 4 * 10);
    EXPECT_NEAR(volume_of_tetrahedra(cells), 0.24, 1e-12);
    EXPECT_NEAR(volume_within(cells), 0.24, 1e-12);

    double error_before = 1;
    for (const double cell : {0.2, 0.1, 0.05}) {
        const Elements ball = reader::mesh_lattice(mesh_of(reader::ball_surface(1, 24)), cell);
        EXPECT_EQ(fault_of(ball, DeformableKind::solid), "");
        const double error = std::abs(volume_of_tetrahedra(ball) - 4 * pi / 3);
        EXPECT_LT(error, error_before);
        for (const Eigen::Vector3d& p : ball.points) EXPECT_LT(p.norm(), 1 + cell);
        error_before = error;
    }
    EXPECT_LT(error_before, 0.05);
}

TEST(DeformableShapes, CellsLeaveOutTheHoleOfATube) {
    // A shell between two balls: the inner one's triangles turned over.
    Elements shell = reader::ball_surface(1, 16);
    const Elements inner = reader::ball_surface(0.5, 16);
    const auto first = static_cast<std::uint32_t>(shell.points.size());
    shell.points.insert(shell.points.end(), inner.points.begin(), inner.points.end());
    for (const auto& [a, b, c] : inner.triangles)
        shell.triangles.push_back({first + a, first + c, first + b});
    const Elements cells = reader::mesh_lattice(mesh_of(shell), 0.05);
    EXPECT_NEAR(volume_of_tetrahedra(cells), 4 * pi / 3 * 0.875, 0.05);
    for (const auto& t : cells.tetrahedra) EXPECT_GT(cells.points[t[0]].norm(), 0.4);

    // Turned over as a whole, it has the same inside.
    for (auto& t : shell.triangles) std::swap(t[0], t[1]);
    EXPECT_EQ(reader::mesh_lattice(mesh_of(shell), 0.05).tetrahedra, cells.tetrahedra);
}

TEST(DeformableShapes, CellsNeedAClosedMeshThatIsNeitherTooLargeNorTooSmall) {
    const auto said = [](const Elements& surface, double cell) -> std::string {
        try {
            reader::mesh_lattice(mesh_of(surface), cell);
        } catch (const BadShape& error) {
            return error.what();
        }
        return "no error";
    };
    const Elements ball = reader::ball_surface(1, 4);
    EXPECT_NE(said(reader::tube_surface(1, 1, {8, 1}, false), 0.1).find("must be closed"),
              std::string::npos);
    EXPECT_NE(said(ball, 1e-6).find("make \"cell\" larger"), std::string::npos);
    EXPECT_NE(said(ball, 0.004).find("make \"cell\" larger"), std::string::npos);
    EXPECT_NE(said(ball, 0.0135).find("more than 1000000 cells inside"), std::string::npos);
    EXPECT_EQ(said(ball, 100), "no error");  // one cell around it has its centre inside
    EXPECT_NE(said(reader::mesh_lattice(mesh_of(ball), 0.5), 0.2), "");
    const Elements bent = [] {
        Elements l = reader::box_lattice({1, 0.1, 1}, {10, 1, 10});
        for (Eigen::Vector3d& p : l.points) p.y() += p.x() * p.x() * 10;
        return l;
    }();
    EXPECT_NE(said(bent, 20).find("make \"cell\" smaller"), std::string::npos);
}

TEST(DeformableShapes, SurfaceIsWhatOneTetrahedronHasAlone) {
    EXPECT_EQ(reader::surface_of({{0, 1, 2, 3}}).size(), 4u);
    EXPECT_EQ(reader::surface_of({{0, 1, 2, 3}, {0, 2, 1, 4}}).size(), 6u);
}

}  // namespace plumb::test
