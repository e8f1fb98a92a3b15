// SPDX-License-Identifier: MIT
#include "reader/meshes/obj.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "geometry/bad_shape.h"
#include "reading.h"

namespace plumb::test {

namespace {

/// A folder of its own, with one OBJ file in it, gone at the end of the test.
class Obj : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = std::filesystem::path(::testing::TempDir()) /
                  (std::string("plumb_obj_") +
                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path file(const std::string& text) {
        const auto path = folder_ / "mesh.obj";
        std::ofstream(path, std::ios::binary) << text;
        return path;
    }

    std::string reason_for(const std::string& text) {
        try {
            reader::load_obj(file(text));
        } catch (const BadShape& error) {
            return error.what();
        }
        return "no error";
    }

    std::filesystem::path folder_;
};

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 9 9 9\n";

TEST_F(Obj, CutsPolygonsAndLeavesOutSpareVertices) {
    const auto mesh = reader::load_obj(file(kSquare + "f 4 3 2 1\n"));
    EXPECT_EQ(mesh.vertices.size(), 4u);
    ASSERT_EQ(mesh.triangles.size(), 2u);
    for (const auto& t : mesh.triangles) {
        const auto n = (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                           .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
        EXPECT_GT(n.y(), 0);
    }
}

TEST_F(Obj, KnowsIndicesFromTheEndAndWithNormals) {
    const auto mesh =
        reader::load_obj(file("v 0 0 0\nv 1 0 0\nv 0 0 -1\nvn 0 1 0\nf -3//1 -2//1 -1//1\n"));
    ASSERT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.vertices[mesh.triangles[0][2]], Eigen::Vector3d(0, 0, -1));
}

TEST_F(Obj, KeepsEveryDigit) {
    const auto mesh = reader::load_obj(file("v 0.123456789012 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    EXPECT_DOUBLE_EQ(mesh.vertices[0].x(), 0.123456789012);
}

TEST_F(Obj, SplitsAtObjectsAndGroups) {
    const auto path = file("o one\n" + kSquare + "f 1 2 3\no empty\ng two\nf 1 3 4\nf 2 3 4\n");
    const auto meshes = reader::load_obj_groups(path);
    ASSERT_EQ(meshes.size(), 2u);
    EXPECT_EQ(meshes[0].name, "one");
    EXPECT_EQ(meshes[0].triangles.size(), 1u);
    EXPECT_EQ(meshes[1].name, "two");
    EXPECT_EQ(meshes[1].triangles.size(), 2u);
}

TEST_F(Obj, SaysWhatIsWrong) {
    EXPECT_NE(reason_for(kSquare).find("no faces"), std::string::npos);
    EXPECT_NE(reason_for("").find("no faces"), std::string::npos);
    EXPECT_NE(reason_for("v 0 0 0\nv 1 nan 0\nv 0 0 1\nf 1 2 3\n").find("line 2"),
              std::string::npos);
    EXPECT_NE(reason_for("v 0 0 0\nv 1 inf 0\nv 0 0 1\nf 1 2 3\n").find("line 2"),
              std::string::npos);
    EXPECT_NE(reason_for("v 0 0 0\nv 1 x 0\nv 0 0 1\nf 1 2 3\n").find("line 2"), std::string::npos);
    EXPECT_NE(reason_for("v 0 0\nf 1 1 1\n").find("line 1"), std::string::npos);
    EXPECT_NE(reason_for("v 0 0 0\nv 1 1e999 0\nv 0 0 1\nf 1 2 3\n").find("line 2"),
              std::string::npos);
    EXPECT_NE(reason_for("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").find("no faces"),
              std::string::npos);
    EXPECT_NE(reason_for("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 9\n").find("mesh.obj"),
              std::string::npos);
    EXPECT_NE(reason_for("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 0 1 2\n").find("mesh.obj"),
              std::string::npos);
}

TEST_F(Obj, RefusalsNameFileAndPlace) {
    expect_error(with_shape(R"({"mesh": {"obj": "meshes/gems.obj"}})"), "/bodies/0/shape/mesh/obj",
                 "there is no mesh file");
    expect_error(with_shape(R"({"hull": {"obj": "meshes"}})"), "/bodies/0/shape/hull/obj",
                 "is a folder; name a file in it");
}

}  // namespace
}  // namespace plumb::test
