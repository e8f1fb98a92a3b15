// SPDX-License-Identifier: MIT
/// Collision meshes of URDF files: where they are looked for, and what becomes of them.
#include "robots.h"

namespace plumb::test {

namespace {

/// A box 1 × 2 × 3 from the origin, closed, counter-clockwise from outside.
const std::string kBox =
    "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

std::string mesh(const std::string& file, const std::string& scale = "1 1 1") {
    return "<mesh filename=\"" + file + "\" scale=\"" + scale + "\"/>";
}

double greatest_z(const Geometry& g) {
    double z = 0;
    for (const Eigen::Vector3d& p : g.vertices) z = std::max(z, p.z());
    return z;
}

}  // namespace

TEST_F(Robots, MeshesOfMovingLinksAreHulls) {
    write("box.obj", kBox);
    const Scene scene = scene_of(link("a", collision(mesh("box.obj", "1 1 2"))));
    ASSERT_EQ(scene.geometries.size(), 1u);
    EXPECT_EQ(scene.geometries[0].kind, ShapeKind::hull);
    EXPECT_EQ(scene.geometries[0].vertices.size(), 8u);
    EXPECT_EQ(scene.geometries[0].faces.size(), 6u);
    EXPECT_EQ(greatest_z(scene.geometries[0]), 6);
}

TEST_F(Robots, MeshesOfFixedLinksStayMeshes) {
    write("box.obj", kBox);
    RobotOptions options;
    options.base = RobotBase::fixed;
    const Scene scene = scene_of(link("a", collision(mesh("box.obj"))), options);
    EXPECT_EQ(scene.geometries[0].kind, ShapeKind::mesh);
    EXPECT_EQ(scene.geometries[0].triangles.size(), 12u);
}

TEST_F(Robots, MirroredMeshesCanBeDecomposed) {
    // Two boxes side by side in one closed mesh, apart: two hulls.
    std::string two = kBox;
    for (const char* p : {"5 0 0", "6 0 0", "6 2 0", "5 2 0", "5 0 3", "6 0 3", "6 2 3", "5 2 3"})
        two += std::string("v ") + p + "\n";
    two +=
        "f 12 11 10 9\nf 13 14 15 16\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\nf 12 9 13 16\n";
    write("two.obj", two);
    RobotOptions options;
    options.decompose = true;
    const Scene scene =
        scene_of(link("a", collision(mesh("two.obj", "-1 1 1"), "<origin xyz='0 0 7'/>")), options);
    const Geometry& g = scene.geometries[0];
    ASSERT_EQ(g.kind, ShapeKind::compound);
    ASSERT_EQ(g.parts.size(), 2u);
    for (const GeometryPart& part : g.parts) {
        EXPECT_EQ(part.geometry.kind, ShapeKind::hull);
        expect_near(part.local.position, {0, 0, 7});
        for (const Eigen::Vector3d& p : part.geometry.vertices) EXPECT_LE(p.x(), 1e-12);
    }
}

TEST_F(Robots, PackagesAreLookedForUpwards) {
    write("bot_description/meshes/box.obj", kBox);
    const auto text = [](const std::string& uri) { return robot(link("a", collision(mesh(uri)))); };
    for (const std::string uri : {"package://bot_description/meshes/box.obj",
                                  "package://renamed/meshes/box.obj", "../meshes/box.obj"}) {
        const auto file = write("bot_description/urdf/bot.urdf", text(uri));
        EXPECT_EQ(read_scene(file).geometries[0].kind, ShapeKind::hull) << uri;
    }
    const auto file =
        write("elsewhere/bot.urdf",
              text("file://" + (folder_ / "bot_description/meshes/box.obj").string()));
    EXPECT_EQ(read_scene(file).geometries[0].kind, ShapeKind::hull);
}

TEST_F(Robots, MissingMeshesAreErrorsUnlessOptional) {
    const std::string gone =
        link("a", collision(mesh("package://p/gone.stl")) + collision("<sphere radius='1'/>"));
    expect_words(error_of(gone), "link \"a\": there is no mesh file \"package://p/gone.stl\"");
    RobotOptions options;
    options.meshes_required = false;
    const Scene scene = scene_of(gone, options);
    EXPECT_EQ(scene.geometries[0].kind, ShapeKind::sphere);
    ASSERT_EQ(scene.remarks.size(), 1u);
    expect_words(scene.remarks[0], "link \"a\": there is no mesh file \"package://p/gone.stl\"");
    expect_words(scene.remarks[0], "left out");
}

TEST_F(Robots, RefuseMeshesThatCannotBeRead) {
    write("a.dae", "<COLLADA/>");
    expect_words(error_of(link("a", collision(mesh("a.dae")))),
                 "link \"a\": the mesh file \"a.dae\" is neither .obj nor .stl");
    write("bad.obj", "v 0 0 x\n");
    expect_words(error_of(link("a", collision(mesh("bad.obj")))), "bad.obj\": line 1");
    write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
    expect_words(error_of(link("a", collision(mesh("flat.obj")))),
                 "the mesh \"flat.obj\": the hull");
    write("box.obj", kBox);
    expect_words(error_of(link("a", collision(mesh("box.obj", "1 0 1")))), "the scale of the mesh");
}

}  // namespace plumb::test
