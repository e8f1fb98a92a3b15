// SPDX-License-Identifier: MIT
#include "reading.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {

namespace {

Geometry shape_of(const std::string& shape) { return scene_of(with_shape(shape)).geometries.at(0); }

const std::string kAt = "/bodies/0/shape";

}  // namespace

TEST(Shapes, SimpleKinds) {
    EXPECT_EQ(shape_of(R"({"plane": {}})").kind, ShapeKind::plane);
    EXPECT_EQ(shape_of(R"({"sphere": {"radius": 2}})").radius, 2);
    EXPECT_EQ(shape_of(R"({"box": {"half_extents": [1, 2, 3]}})").half_extents,
              Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(shape_of(R"({"box": {"size": [2, 4, 6]}})").half_extents, Eigen::Vector3d(1, 2, 3));
    const std::vector<std::pair<std::string, ShapeKind>> round = {{"capsule", ShapeKind::capsule},
                                                                  {"cylinder", ShapeKind::cylinder},
                                                                  {"cone", ShapeKind::cone}};
    for (const auto& [key, kind] : round) {
        const Geometry g = shape_of("{\"" + key + R"(": {"radius": 2, "half_height": 3}})");
        EXPECT_EQ(g.kind, kind);
        EXPECT_EQ(g.radius, 2);
        EXPECT_EQ(g.half_height, 3);
    }
}

TEST(Shapes, HaveExactlyOneKindThatIsKnown) {
    expect_error(with_shape("{}"), kAt, "exactly one key");
    expect_error(with_shape(R"({"sphere": {"radius": 1}, "plane": {}})"), kAt, "exactly one key");
    expect_error(with_shape(R"({"shpere": {"radius": 1}})"), kAt + "/shpere",
                 "did you mean \"sphere\"?");
    expect_error(with_shape("3"), kAt, "must be an object");
}

TEST(Shapes, RefuseImpossibleSizes) {
    expect_error(with_shape(R"({"sphere": {"radius": -1}})"), kAt + "/sphere/radius", "above 0");
    expect_error(with_shape(R"({"sphere": {"radius": 0}})"), kAt + "/sphere/radius", "above 0");
    expect_error(with_shape(R"({"sphere": {}})"), kAt + "/sphere", "\"radius\" is missing");
    expect_error(with_shape(R"({"box": {"size": [1, -1, 1]}})"), kAt + "/box/size/1", "above 0");
    expect_error(with_shape(R"({"box": {"size": [1, 1, 1], "half_extents": [1, 1, 1]}})"),
                 kAt + "/box", "either \"half_extents\" or \"size\"");
}

TEST(Shapes, AreSharedByName) {
    const Scene scene = scene_of(R"({"shapes": {"ball": {"sphere": {"radius": 1}}},
                                     "bodies": [{"shape": "ball"}, {"shape": "ball"}]})");
    EXPECT_EQ(scene.geometries.size(), 1u);
    EXPECT_EQ(scene.geometries[0].name, "ball");
    EXPECT_EQ(scene.bodies[1].geometry, 0u);
    expect_error(R"({"shapes": {"ball": {"sphere": {"radius": 1}}}, "bodies": [{"shape": "bal"}]})",
                 "/bodies/0/shape", "did you mean \"ball\"?");
}

TEST(Shapes, HullFromPointsAndFromAFile) {
    const Geometry tetrahedron =
        shape_of(R"({"hull": {"vertices": [[0,0,0], [1,0,0], [0,1,0], [0,0,1], [0.1,0.1,0.1]]}})");
    EXPECT_EQ(tetrahedron.vertices.size(), 4u);
    EXPECT_EQ(tetrahedron.faces.size(), 4u);

    const Geometry gem = shape_of(R"({"hull": {"obj": "meshes/gem.obj", "scale": 2}})");
    EXPECT_EQ(gem.kind, ShapeKind::hull);
    EXPECT_EQ(gem.vertices.size(), 20u);
    ASSERT_EQ(gem.faces.size(), 12u);
    for (const auto& face : gem.faces) EXPECT_EQ(face.size(), 5u);
    EXPECT_NEAR(gem.vertices[0].norm(), 0.5, 1e-8);
}

TEST(Shapes, RefuseHullsWithoutVolume) {
    expect_error(with_shape(R"({"hull": {"vertices": [[0,0,0], [1,0,0], [0,1,0], [1,1,0]]}})"),
                 kAt + "/hull", "flat");
    expect_error(with_shape(R"({"hull": {"vertices": [[0,0,0]]}})"), kAt + "/hull",
                 "at least 4 points");
    expect_error(with_shape(R"({"hull": {"vertices": [[0,0,0], [1,0]]}})"),
                 kAt + "/hull/vertices/1", "a list of 3 numbers");
    expect_error(with_shape(R"({"hull": {}})"), kAt + "/hull", "either \"vertices\" or \"obj\"");
    expect_error(with_shape(R"({"hull": {"vertices": [], "scale": 2}})"), kAt + "/hull/scale",
                 "\"obj\" alone");
}

TEST(Shapes, MeshFromTrianglesAndFromAFile) {
    const Geometry mesh = shape_of(
        R"({"mesh": {"vertices": [[0,0,0], [0,0,1], [1,0,0], [1,0,1]], "triangles": [[0,1,2], [2,1,3]]}})");
    EXPECT_EQ(mesh.kind, ShapeKind::mesh);
    EXPECT_EQ(mesh.triangles.size(), 2u);
    const Geometry terrain = shape_of(R"({"mesh": {"obj": "meshes/terrain.obj"}})");
    EXPECT_EQ(terrain.triangles.size(), 288u);
    EXPECT_EQ(terrain.vertices.size(), 169u);
}

TEST(Shapes, RefuseBadTriangles) {
    const std::string head = R"({"mesh": {"vertices": [[0,0,0], [1,0,0], [2,0,0]], "triangles": )";
    expect_error(with_shape(head + "[[0, 1, 3]]}}"), kAt + "/mesh/triangles/0", "not there");
    expect_error(with_shape(head + "[[0, 1, 2]]}}"), kAt + "/mesh/triangles/0", "no area");
    expect_error(with_shape(head + "[[0, 1, -1]]}}"), kAt + "/mesh/triangles/0/2", "whole number");
    expect_error(with_shape(head + "[]}}"), kAt + "/mesh/triangles", "at least one triangle");
    expect_error(with_shape(R"({"mesh": {"vertices": [[0,0,0]]}})"), kAt + "/mesh",
                 "\"triangles\" is missing");
}

TEST(Shapes, HeightField) {
    const Geometry g = shape_of(
        R"({"height_field": {"rows": 2, "columns": 3, "spacing": [0.5, 2], "heights": [0, 1, 2, 3, 4, 5]}})");
    EXPECT_EQ(g.kind, ShapeKind::height_field);
    EXPECT_EQ(g.rows, 2u);
    EXPECT_EQ(g.columns, 3u);
    EXPECT_EQ(g.spacing_x, 0.5);
    EXPECT_EQ(g.spacing_z, 2);
    EXPECT_EQ(g.heights[5], 5);
    expect_error(
        with_shape(
            R"({"height_field": {"rows": 2, "columns": 3, "spacing": [1, 1], "heights": [0, 1]}})"),
        kAt + "/height_field/heights", "= 6 heights");
    expect_error(
        with_shape(
            R"({"height_field": {"rows": 1, "columns": 3, "spacing": [1, 1], "heights": []}})"),
        kAt + "/height_field/rows", "from 2");
}

TEST(Shapes, HillsAreSmoothAndTheSameForASeed) {
    const auto hills = [](const std::string& keys) {
        return R"({"rows": 41, "columns": 61, "spacing": [0.25, 0.5], "hills": {)" + keys + "}}";
    };
    const auto field = [&](const std::string& keys) {
        return shape_of(R"({"height_field": )" + hills(keys) + "}");
    };
    const Geometry g = field(R"("amplitude": 2, "wavelength": 5, "seed": 3)");
    ASSERT_EQ(g.heights.size(), 41u * 61u);
    const auto [low, high] = std::minmax_element(g.heights.begin(), g.heights.end());
    EXPECT_GE(*low, -2);
    EXPECT_LE(*high, 2);
    EXPECT_GT(*high - *low, 1.5);
    // The blend's steepest slope is 15/8 of the lattice's, whose heights differ by 4 at most.
    for (std::size_t i = 1; i < 61; ++i)
        EXPECT_LE(std::abs(g.heights[i] - g.heights[i - 1]), 15.0 / 8 * 4 / 5 * 0.25);
    EXPECT_EQ(g.heights, field(R"("amplitude": 2, "wavelength": 5, "seed": 3)").heights);
    EXPECT_NE(g.heights, field(R"("amplitude": 2, "wavelength": 5, "seed": 4)").heights);

    const Geometry mesh = shape_of(R"({"mesh": {"height_field": )" +
                                   hills(R"("amplitude": 2, "wavelength": 5, "seed": 3)") + "}}");
    EXPECT_EQ(mesh.kind, ShapeKind::mesh);
    EXPECT_EQ(mesh.triangles.size(), 2u * 40 * 60);
    EXPECT_EQ(mesh.vertices[61], Eigen::Vector3d(-7.5, g.heights[61], -9.5));
    for (const auto& [a, b, c] : mesh.triangles) {
        const Eigen::Vector3d u = mesh.vertices[b] - mesh.vertices[a];
        EXPECT_GT(u.cross(mesh.vertices[c] - mesh.vertices[a]).y(), 0);
    }
}

TEST(Shapes, RefuseBadHills) {
    const auto field = [](const std::string& keys) {
        return with_shape(R"({"height_field": {"rows": 3, "columns": 3, "spacing": [1, 1])" + keys +
                          "}}");
    };
    const std::string at = kAt + "/height_field";
    expect_error(field(""), at, "either \"heights\" or \"hills\"");
    expect_error(field(R"(, "hill": {})"), at + "/hill", "did you mean \"hills\"?");
    expect_error(field(R"(, "hills": {"amplitude": 1})"), at + "/hills",
                 "\"wavelength\" is missing");
    expect_error(field(R"(, "hills": {"amplitude": 1, "wavelength": 1e-5})"), at + "/hills",
                 "too fine");
}

TEST(Shapes, TorusOfWedgesContainsTheTorus) {
    const Geometry g =
        shape_of(R"({"torus": {"ring_radius": 0.5, "tube_radius": 0.2, "segments": 16}})");
    ASSERT_EQ(g.parts.size(), 16u);
    const auto depth = [&](const Eigen::Vector3d& p) {
        double most = -1;
        for (const GeometryPart& part : g.parts) {
            double least = 1;
            for (const auto& face : part.geometry.faces) {
                const auto& v = part.geometry.vertices;
                const Eigen::Vector3d normal =
                    (v[face[1]] - v[face[0]]).cross(v[face[2]] - v[face[0]]).normalized();
                least = std::min(least, normal.dot(v[face[0]] - p));
            }
            most = std::max(most, least);
        }
        return most;
    };
    double deepest = 0;
    for (int i = 0; i < 97; ++i)
        for (int k = 0; k < 31; ++k) {
            const double phi = 2 * 3.14159265358979 * i / 97, t = 2 * 3.14159265358979 * k / 31;
            const double rho = 0.5 + 0.2 * std::cos(t);
            const double d = depth({rho * std::cos(phi), 0.2 * std::sin(t), rho * std::sin(phi)});
            EXPECT_GE(d, -1e-12) << i << " " << k;
            deepest = std::max(deepest, d);
        }
    // No point of the surface lies deeper than the corners of the outline stand out.
    EXPECT_LT(deepest, 0.7 * (1 / std::cos(3.14159265358979 / 16) - 1) +
                           0.2 * (1 / std::cos(3.14159265358979 / 12) - 1));

    expect_error(with_shape(R"({"torus": {"ring_radius": 0.5, "tube_radius": 0.5}})"),
                 kAt + "/torus", "no hole");
    expect_error(with_shape(R"({"torus": {"ring_radius": 0.5}})"), kAt + "/torus",
                 "\"tube_radius\" is missing");
    expect_error(with_shape(R"({"tours": {}})"), kAt + "/tours", "did you mean \"torus\"?");
}

TEST(Shapes, CompoundFromParts) {
    const Scene scene = scene_of(R"({"shapes": {
        "a_compound": {"compound": {"parts": [{"shape": "ball", "position": [1, 0, 0]},
                                              {"shape": {"box": {"size": [1, 1, 1]}}}]}},
        "ball": {"sphere": {"radius": 0.5}}}})");
    const Geometry& g = scene.geometries.at(1);
    EXPECT_EQ(g.name, "a_compound");
    ASSERT_EQ(g.parts.size(), 2u);
    EXPECT_EQ(g.parts[0].geometry.radius, 0.5);
    EXPECT_EQ(g.parts[0].local.position, Eigen::Vector3d(1, 0, 0));
    EXPECT_EQ(g.parts[1].geometry.kind, ShapeKind::box);
}

TEST(Shapes, CompoundFromAFileHasAHullForEachObject) {
    const Geometry g = shape_of(R"({"compound": {"obj": "meshes/table.obj", "scale": 0.5}})");
    ASSERT_EQ(g.parts.size(), 5u);
    EXPECT_EQ(g.parts[0].geometry.name, "top");
    for (const auto& part : g.parts) {
        EXPECT_EQ(part.geometry.vertices.size(), 8u);
        EXPECT_EQ(part.geometry.faces.size(), 6u);
    }
    EXPECT_NEAR(std::abs(g.parts[0].geometry.vertices[0].x()), 0.2, 1e-12);
    expect_error(with_shape(R"({"compound": {"obj": "meshes/terrain.objx"}})"),
                 kAt + "/compound/obj", "there is no mesh file");
}

TEST(Shapes, CompoundsDoNotNest) {
    expect_error(with_shape(R"({"compound": {"parts": [{"shape": {"plane": {}}}]}})"),
                 kAt + "/compound/parts/0/shape", "cannot be a plane");
    expect_error(R"({"shapes": {"a": {"compound": {"parts": [{"shape": "a"}]}}}})",
                 "/shapes/a/compound/parts/0/shape", "there is no shape named \"a\"");
    expect_error(with_shape(R"({"compound": {"parts": []}})"), kAt + "/compound/parts",
                 "at least one part");
    expect_error(with_shape(R"({"compound": {}})"), kAt + "/compound",
                 "either \"parts\" or \"obj\"");
}

}  // namespace plumb::test
