// SPDX-License-Identifier: MIT
#include "reader/meshes/tet_meshes.h"

#include "geometry/bad_shape.h"
#include "math/random.h"
#include "reading.h"
#include "scene/surface_faults.h"
#include "temporary_files.h"

namespace plumb::test {

namespace {

using reader::Elements;

// Two tetrahedra on one face, the second of them inside out, with a point that nothing uses; as
// well the two triangles of a side, a line, and a point.
const std::string kOld = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
3 7 "jelly"
$EndPhysicalNames
$Nodes
6
10 0 0 0
11 1 0 0
12 0 1 0
13 0 0 1
20 9 9 9
14 0 0 -1
$EndNodes
$Elements
6
1 15 2 0 1 10
2 1 2 0 1 10 11
3 2 2 0 1 10 12 11
4 2 2 0 1 10 11 13
5 4 2 7 1 10 11 12 13
6 4 2 7 1 10 11 12 14
$EndElements
)";

// The same, but for the point and the line; the nodes of the second block have parameters.
const std::string kNew = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 1 1
1 0 0 0 1 1 1 0 0
$EndEntities
$Nodes
2 6 10 20
3 1 0 4
10
11
12
13
0 0 0
1 0 0
0 1 0
0 0 1
2 1 1 2
20
14
9 9 9 0.5 0.5
0 0 -1 0.25 0.75
$EndNodes
$Elements
2 4 3 6
2 1 2 2
3 10 12 11
4 10 11 13
3 1 4 2
5 10 11 12 13
6 10 11 12 14
$EndElements
)";

const std::string kNodes =
    "# points\n5 3 1 1\n0 0 0 0 1.5 1\n1 1 0 0 1.5 1 # a corner\n"
    "2 0 1 0 1.5 1\n\n3 0 0 1 1.5 0\n4 0 0 -1 1.5 0\n";
const std::string kTetrahedra = "2 4 1\n0 0 1 2 3 7\n1 0 1 2 4 7\n# the end\n";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

class TetMeshes : public TemporaryFiles {
protected:
    std::string said_of_msh(const std::string& text, bool tetrahedra = true) {
        try {
            reader::load_gmsh(file("mesh.msh", text), tetrahedra);
        } catch (const BadShape& error) {
            return error.what();
        }
        return "no error";
    }

    std::string said_of_tetgen(const std::string& nodes, const std::string& tetrahedra) {
        file("mesh.ele", tetrahedra);
        try {
            reader::load_tetgen(file("mesh.node", nodes));
        } catch (const BadShape& error) {
            return error.what();
        }
        return "no error";
    }

    static void expect_words(const std::string& said, const std::string& words) {
        EXPECT_NE(said.find(words), std::string::npos) << said;
    }

    /// A scene that has the file as a deformable of a kind.
    Scene scene_with(const std::string& kind, const std::string& mesh) {
        return parse_scene(R"({"deformables": [{"name": "pear", "kind": ")" + kind +
                               R"(", "shape": {"mesh": )" + mesh + "}}]}",
                           folder_ / "scene.json");
    }

    std::string said_of_scene(const std::string& kind, const std::string& mesh) {
        try {
            scene_with(kind, mesh);
        } catch (const SceneError& error) {
            return error.what();
        }
        return "no error";
    }
};

void expect_two_tetrahedra(const Elements& made) {
    EXPECT_EQ(made.points.size(), 5u);
    ASSERT_EQ(made.tetrahedra.size(), 2u);
    EXPECT_EQ(made.points[made.tetrahedra[0][3]], Eigen::Vector3d(0, 0, 1));
    EXPECT_EQ(made.points[made.tetrahedra[1][3]], Eigen::Vector3d(0, 0, -1));
    EXPECT_EQ(made.points[made.tetrahedra[1][1]], Eigen::Vector3d(1, 0, 0));
}

TEST_F(TetMeshes, AreReadFromBothVersionsOfGmsh) {
    for (const std::string& text : {kOld, kNew}) {
        const Elements solid = reader::load_gmsh(file("mesh.msh", text), true);
        expect_two_tetrahedra(solid);
        EXPECT_TRUE(solid.triangles.empty());
        const Elements surface = reader::load_gmsh(file("mesh.msh", text), false);
        EXPECT_EQ(surface.points.size(), 4u);
        EXPECT_EQ(surface.triangles.size(), 2u);
        EXPECT_TRUE(surface.tetrahedra.empty());
    }
}

TEST_F(TetMeshes, MayHaveWindowsLineEnds) {
    std::string text;
    for (const char c : kOld) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
    expect_two_tetrahedra(reader::load_gmsh(file("mesh.msh", text), true));
}

TEST_F(TetMeshes, AreReadFromTetgenCountedFromZeroOrOne) {
    file("mesh.ele", kTetrahedra);
    expect_two_tetrahedra(reader::load_tetgen(file("mesh.node", kNodes)));

    file("mesh.ele", "2 10\n1 1 2 3 4 1 1 1 1 1 1\n2 1 2 3 5 1 1 1 1 1 1\n");
    expect_two_tetrahedra(reader::load_tetgen(
        file("mesh.node", "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 0 0 -1\n")));
}

TEST_F(TetMeshes, OfGmshSayWhatIsWrong) {
    const auto says = [&](const std::string& text, const std::string& words) {
        expect_words(said_of_msh(text), words);
        expect_words(said_of_msh(text), "mesh.msh");
    };
    says("", "line 1: the file ends where \"$MeshFormat\" should follow");
    says("solid", "line 1: a .msh file must begin with \"$MeshFormat\"");
    says(replaced(kOld, "2.2 0 8", "4 0 8"),
         "line 2: the file is of version 4; 2.2 and 4.1 are read");
    says(replaced(kOld, "2.2 0 8", "2.2 1 8"), "the file is binary");
    says(replaced(kOld, "11 1 0 0", "11 1 x 0"),
         "line 11: there must be a finite number, y, not \"x\"");
    says(replaced(kOld, "11 1 0 0", "11 1 nan 0"), "line 11: there must be a finite number, y");
    says(replaced(kOld, "11 1 0 0", "10 1 0 0"), "line 11: point 10 is there twice");
    says(replaced(kOld, "10 11 12 14", "10 11 12 15"), "line 24: there is no point 15");
    says(replaced(kOld, "$Nodes\n6", "$Nodes\n-6"), "line 9: there must be a whole number");
    says(replaced(kOld, "$Nodes\n6", "$Nodes\n99999999999"), "there must be a whole number");
    says(replaced(kOld, "6 4 2 7 1 10 11 12 14", "6 5 2 7 1 10 11 12 14 10 11 12 14"),
         "elements of type 5 are not read; only tetrahedra of 4 points (type 4) can be a solid");
    says(replaced(kOld, "6 4 2 7", "6 99 2 7"), "elements of type 99 are not known");
    says(replaced(kOld, "$Nodes", "$Knots"), "the file ends where \"$EndKnots\" should follow");
    says(replaced(kOld, "$PhysicalNames", "Names"), "a section must begin with \"$\"");
    says(kOld.substr(0, kOld.find("$Elements")), "there are no tetrahedra in it");
    says("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + kOld.substr(kOld.find("$Elements")),
         "\"$Nodes\" must come before \"$Elements\"");
    says(replaced(kNew, "3 1 4 2\n5", "3 1 4 3\n5"), "there must be a whole number");
    expect_words(said_of_msh(replaced(kOld, "4 2 2 0 1 10 11 13", "4 3 2 0 1 10 11 12 13"), false),
                 "only triangles of 3 points (type 2) can be a surface");
    expect_words(said_of_msh(replaced(kOld, "4 2 2 0 1 10 11 13", "4 3 2 0 1 10 11 12 13")),
                 "no error");
}

TEST_F(TetMeshes, OfTetgenSayWhatIsWrong) {
    expect_words(said_of_tetgen(replaced(kNodes, "5 3 1 1", "5 2 1 1"), kTetrahedra),
                 "mesh.node\": line 2: the points must have three coordinates");
    expect_words(said_of_tetgen(replaced(kNodes, "5 3 1 1", "6 3 1 1"), kTetrahedra),
                 "mesh.node\": line 9: the file ends where the number of a point should follow");
    expect_words(said_of_tetgen(replaced(kNodes, "1 1 0 0", "0 1 0 0"), kTetrahedra),
                 "line 4: point 0 is there twice");
    expect_words(said_of_tetgen(kNodes, replaced(kTetrahedra, "2 4 1", "2 8 1")),
                 "mesh.ele\": line 1: a tetrahedron must have 4 or 10 points");
    expect_words(said_of_tetgen(kNodes, replaced(kTetrahedra, "0 1 2 4", "0 1 2 5")),
                 "mesh.ele\": line 3: there is no point 5");
    expect_words(said_of_tetgen(kNodes, "0 4 0\n"), "there are no tetrahedra in it");
    file("alone.node", kNodes);
    expect_words(said_of_scene("solid", R"({"file": "alone.node"})"), "there is no mesh file");
}

TEST_F(TetMeshes, BecomeSolidsOfAScene) {
    file("mesh.msh", kOld);
    const DeformableSpec d =
        scene_with("solid", R"({"file": "mesh.msh", "scale": 2})").deformables[0];
    EXPECT_EQ(d.points.size(), 5u);
    EXPECT_EQ(d.triangles.size(), 6u);
    EXPECT_NEAR(deformable_faults::enclosed_volume(d.points, d.triangles), 8 / 3., 1e-12);

    file("mesh.node", kNodes);
    file("mesh.ele", kTetrahedra);
    EXPECT_EQ(scene_with("solid", R"({"file": "mesh.node"})").deformables[0].tetrahedra.size(), 2u);
}

TEST_F(TetMeshes, AreOfTheKindThatIsAskedFor) {
    file("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    file("mesh.node", kNodes);
    file("mesh.txt", "");
    const std::string place = "/deformables/0/shape/mesh/file: ";
    expect_words(said_of_scene("solid", R"({"file": "mesh.obj"})"),
                 place + "an OBJ file has no tetrahedra");
    expect_words(said_of_scene("cloth", R"({"file": "mesh.node"})"),
                 place + "a .node file has tetrahedra");
    expect_words(said_of_scene("cloth", R"({"file": "mesh.txt"})"),
                 place + "the name of a mesh file ends in .obj, .msh or .node");
    expect_words(said_of_scene("rope", R"({"file": "mesh.obj"})"),
                 place + "a rope cannot be read from a file");
    expect_words(said_of_scene("cloth", R"({"file": "none.obj"})"),
                 place + "there is no mesh file");
    expect_words(said_of_scene("cloth", R"({"file": "mesh.obj", "scale": 1e6, "triangles": []})"),
                 "go with \"points\", not with \"file\"");
    EXPECT_EQ(scene_with("cloth", R"({"file": "mesh.obj"})").deformables[0].points.size(), 3u);
}

TEST_F(TetMeshes, ThatComeApartAtSeamsAreMergedWithARemark) {
    // A tetrahedron whose faces have corners of their own.
    file("mesh.obj",
         "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 0 0\nv 0 0 1\nv 0 1 0\n"
         "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 4 5 6\nf 7 8 9\nf 10 11 12\n");
    const Scene scene = scene_with("balloon", R"({"file": "mesh.obj"})");
    EXPECT_EQ(scene.deformables[0].points.size(), 4u);
    EXPECT_EQ(scene.remarks, (std::vector<std::string>{
                                 "deformable \"pear\": 8 points of \"mesh.obj\" lay where others "
                                 "did and became one with them"}));
}

TEST_F(TetMeshes, ThatArePartlyInsideOutAreTurnedOverWithARemark) {
    file("mesh.msh", kOld);
    EXPECT_EQ(
        scene_with("solid", R"({"file": "mesh.msh"})").remarks,
        (std::vector<std::string>{
            "deformable \"pear\": tetrahedra of \"mesh.msh\" that were inside out were turned "
            "over: 1 of 2, the first about (0.25, 0.25, -0.25)"}));
    // all the other way about is only another program's order
    for (const char* corners : {"1 2 3 4", "2 1 3 4"}) {
        file("mesh.ele", std::string("1 4\n1 ") + corners + "\n");
        file("mesh.node", "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n");
        const Scene scene = scene_with("solid", R"({"file": "mesh.node"})");
        EXPECT_TRUE(scene.remarks.empty());
        EXPECT_GT(deformable_faults::relative_extent(scene.deformables[0].points,
                                                     scene.deformables[0].tetrahedra[0]),
                  0);
    }
}

TEST_F(TetMeshes, ThatAreDamagedAreMeshesOrErrors) {
    plumb::Random random(7);
    int good = 0, bad = 0;
    const std::string letters = "0123456789.-+e$#E \n\t\xffnax";
    for (int round = 0; round < 600; ++round) {
        std::string text = std::array{kOld, kNew, kNodes, kTetrahedra}[random.below(4)];
        const bool nodes = text == kNodes, tetrahedra = text == kTetrahedra;
        for (std::size_t i = random.below(3) + 1; i > 0; --i) {
            const std::size_t at = random.below(text.size());
            if (random.below(4) == 0)
                text.erase(at, random.below(20));
            else
                text[at] = letters[random.below(letters.size())];
        }
        const std::string said = nodes        ? said_of_tetgen(text, kTetrahedra)
                                 : tetrahedra ? said_of_tetgen(kNodes, text)
                                              : said_of_msh(text);
        said == "no error" ? ++good : ++bad;
    }
    EXPECT_GT(good, 20);
    EXPECT_GT(bad, 200);
}

}  // namespace
}  // namespace plumb::test
