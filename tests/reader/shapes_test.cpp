// SPDX-License-Identifier: MIT
#include "reading.h"

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
