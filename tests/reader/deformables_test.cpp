// SPDX-License-Identifier: MIT
#include "scene/deformable_faults.h"

#include <cmath>

#include "reading.h"

namespace plumb::test {

namespace {

/// A scene with one deformable, whose keys are given.
std::string with(const std::string& keys) {
    return R"({"materials": {"silk": {"density": 300}},
               "bodies": [{"name": "pole", "motion": "fixed", "shape": {"sphere": {"radius": 1}}, "position": [0, 1, 0]}],
               "deformables": [{)" +
           keys + "}]}";
}

const std::string kCloth =
    R"("name": "sheet", "kind": "cloth", "shape": {"grid": {"cells": [2, 1], "size": [2, 3]}})";
const std::string kBalloon =
    R"("kind": "balloon", "shape": {"sphere": {"radius": 0.5, "cells": 2}})";
const std::string kSolid =
    R"("kind": "solid", "shape": {"lattice": {"size": [1, 1, 1], "cells": [1, 1, 1]}})";
const std::string kRope =
    R"("kind": "rope", "shape": {"line": {"from": [0, 0, 0], "to": [0, 2, 0], "segments": 2}})";

/// A deformable of listed points and elements.
std::string mesh(const std::string& kind, const std::string& points, const std::string& elements) {
    return "\"kind\": \"" + kind + "\", \"shape\": {\"mesh\": {\"points\": " + points + ", " +
           elements + "}}";
}

const std::string kFour = "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]";
const std::string kFaces = "[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]";

}  // namespace

TEST(Deformables, HaveAllTheirKeys) {
    const Scene scene = scene_of(with(kCloth + R"(, "position": [0, 5, 0],
        "rotation": {"axis": [1, 0, 0], "degrees": 90}, "velocity": [1, 2, 3], "material": "silk",
        "mass": 0.5, "thickness": 0.002, "young": 2e7, "poisson": 0.2, "bending": 0.01, "damping": 0.003,
        "radius": 0.02, "drag": 1.5, "skin_drag": 0.02, "tearing_strain": 0.4, "group": 2, "mask": 5, "color": "#102030")"));
    ASSERT_EQ(scene.deformables.size(), 1u);
    const DeformableSpec& d = scene.deformables[0];
    EXPECT_EQ(d.name, "sheet");
    EXPECT_EQ(d.kind, DeformableKind::cloth);
    ASSERT_EQ(d.points.size(), 6u);
    // +z turns to -y.
    EXPECT_LT((d.points[0] - Eigen::Vector3d(-1, 6.5, 0)).norm(), 1e-12);
    EXPECT_LT((d.points[5] - Eigen::Vector3d(1, 3.5, 0)).norm(), 1e-12);
    EXPECT_EQ(d.velocity, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(scene.materials[d.material].name, "silk");
    EXPECT_EQ(d.mass, 0.5);
    EXPECT_EQ(d.thickness, 0.002);
    EXPECT_EQ(d.elasticity.youngs_modulus, 2e7);
    EXPECT_EQ(d.elasticity.poissons_ratio, 0.2);
    EXPECT_EQ(d.elasticity.bending_stiffness, 0.01);
    EXPECT_EQ(d.elasticity.damping, 0.003);
    EXPECT_EQ(d.radius, 0.02);
    EXPECT_EQ(d.drag, 1.5);
    EXPECT_EQ(d.skin_drag, 0.02);
    EXPECT_EQ(d.tearing_strain, 0.4);
    EXPECT_EQ(d.group, 2u);
    EXPECT_EQ(d.mask, 5u);
    EXPECT_EQ(d.color, 0x102030u);
}

TEST(Deformables, HaveDefaultsOfTheirKind) {
    const DeformableSpec rope = scene_of(with(kRope)).deformables[0];
    EXPECT_EQ(rope.name, "deformable_1");
    EXPECT_EQ(rope.thickness, 0.01);
    EXPECT_EQ(rope.elasticity.youngs_modulus, 1e8);
    EXPECT_DOUBLE_EQ(rope.radius, 0.1);  // a tenth of a segment
    EXPECT_TRUE(std::isinf(rope.tearing_strain));

    const DeformableSpec cloth = scene_of(with(kCloth + R"(, "thickness": 1)")).deformables[0];
    EXPECT_EQ(cloth.radius, 0.5);  // half the thickness
    EXPECT_EQ(cloth.elasticity.youngs_modulus, 1e6);
    EXPECT_FALSE(cloth.elasticity.bending_stiffness.has_value());
    EXPECT_FALSE(cloth.mass.has_value());

    const DeformableSpec balloon = scene_of(with(kBalloon)).deformables[0];
    EXPECT_EQ(balloon.volume_ratio, 1);
    EXPECT_FALSE(balloon.pressure.has_value());
    EXPECT_EQ(scene_of(with(kBalloon + R"(, "pressure": 2000)")).deformables[0].pressure, 2000);
    EXPECT_EQ(scene_of(with(kBalloon + R"(, "volume_ratio": 2)")).deformables[0].volume_ratio, 2);

    const DeformableSpec solid = scene_of(with(kSolid)).deformables[0];
    // Four tetrahedra with three edges and three diagonals each, and one of six diagonals.
    EXPECT_NEAR(solid.radius, 0.1 * (12 + 18 * std::sqrt(2.0)) / 30, 1e-12);
    EXPECT_EQ(solid.triangles.size(), 12u);
}

TEST(Deformables, AreReadFromListedElements) {
    const DeformableSpec rope =
        scene_of(with(mesh("rope", "[[0, 0, 0], [1, 0, 0]]", "\"segments\": [[1, 0]]")))
            .deformables[0];
    EXPECT_EQ(rope.segments[0], (std::array<std::uint32_t, 2>{1, 0}));
    EXPECT_EQ(scene_of(with(mesh("cloth", kFour, "\"triangles\": " + kFaces)))
                  .deformables[0]
                  .triangles.size(),
              4u);
    const DeformableSpec solid =
        scene_of(with(mesh("solid", kFour, "\"tetrahedra\": [[0, 1, 2, 3]]"))).deformables[0];
    EXPECT_EQ(solid.triangles.size(), 4u);
    EXPECT_NEAR(deformable_faults::enclosed_volume(solid.points, solid.triangles), 1 / 6., 1e-15);
}

TEST(Deformables, ThatAreTurnedInsideOutAreTurnedBackWithARemark) {
    const Scene scene = scene_of(with(
        "\"name\": \"pear\", " +
        mesh("balloon", kFour, "\"triangles\": [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]")));
    const DeformableSpec& d = scene.deformables[0];
    EXPECT_NEAR(deformable_faults::enclosed_volume(d.points, d.triangles), 1 / 6., 1e-15);
    ASSERT_EQ(scene.remarks.size(), 1u);
    EXPECT_NE(scene.remarks[0].find("\"pear\": its triangles faced inwards"), std::string::npos);
    EXPECT_TRUE(scene_of(with(mesh("balloon", kFour, "\"triangles\": " + kFaces))).remarks.empty());
}

TEST(Deformables, RefuseNumbersOutOfRange) {
    const auto refused = [](const std::string& keys, const std::string& key) {
        expect_error(with(keys), "/deformables/0/" + key, "must be");
    };
    refused(kCloth + R"(, "thickness": 0)", "thickness");
    refused(kCloth + R"(, "young": 0)", "young");
    refused(kCloth + R"(, "young": -1)", "young");
    refused(kCloth + R"(, "poisson": 1)", "poisson");
    refused(kCloth + R"(, "poisson": -1)", "poisson");
    refused(kCloth + R"(, "poisson": -1.5)", "poisson");
    refused(kSolid + R"(, "poisson": 0.5)", "poisson");
    refused(kCloth + R"(, "bending": -1)", "bending");
    refused(kCloth + R"(, "damping": -1)", "damping");
    refused(kBalloon + R"(, "volume_ratio": 0)", "volume_ratio");
    refused(kBalloon + R"(, "pressure": 1e13)", "pressure");
    refused(kCloth + R"(, "radius": 0)", "radius");
    refused(kCloth + R"(, "drag": -1)", "drag");
    refused(kCloth + R"(, "skin_drag": -1)", "skin_drag");
    refused(kCloth + R"(, "mass": 0)", "mass");
    refused(kCloth + R"(, "tearing_strain": 0)", "tearing_strain");
    refused(kCloth + R"(, "velocity": [0, 1e10, 0])", "velocity/1");
}

TEST(Deformables, RefuseKeysOfOtherKinds) {
    const auto refused = [](const std::string& keys, const std::string& key,
                            const std::string& words) {
        expect_error(with(keys), "/deformables/0/" + key, words);
    };
    refused(kSolid + R"(, "thickness": 1)", "thickness", "a solid has no \"thickness\"");
    refused(kSolid + R"(, "bending": 1)", "bending", "a solid has no \"bending\"");
    refused(kRope + R"(, "drag": 1)", "drag", "a rope has no \"drag\"");
    refused(kRope + R"(, "poisson": 0.1)", "poisson", "a rope has no \"poisson\"");
    refused(kCloth + R"(, "pressure": 1)", "pressure", "a cloth has no \"pressure\"");
    refused(kRope + R"(, "volume_ratio": 1)", "volume_ratio", "a rope has no \"volume_ratio\"");
    expect_error(with(kBalloon + R"(, "volume_ratio": 1, "pressure": 1)"), "/deformables/0",
                 "either a \"pressure\" or a \"volume_ratio\"");
    refused(R"("kind": "rope", "shape": {"grid": {"size": [1, 1]}})", "shape/grid",
            "a rope cannot be a \"grid\", which is for cloth");
    refused(R"("kind": "cloth", "shape": {"lattice": {}})", "shape/lattice",
            "a cloth cannot be a \"lattice\", which is for solid");
    refused(R"("kind": "solid", "shape": {"tube": {"radius": 1, "length": 1}})", "shape/tube",
            "which is for cloth or balloon");
}

TEST(Deformables, RefuseWhatTheyDoNotKnow) {
    expect_error(R"({"deformables": {}})", "/deformables", "a list of deformables");
    expect_error(with(R"("kind": "cloath")"), "/deformables/0/kind", "did you mean \"cloth\"?");
    expect_error(with(R"("shape": {"grid": {"size": [1, 1]}})"), "/deformables/0",
                 "\"kind\" is missing");
    expect_error(with(R"("kind": "cloth")"), "/deformables/0", "\"shape\" is missing");
    expect_error(with(kCloth + R"(, "yuong": 1)"), "/deformables/0/yuong",
                 "did you mean \"young\"?");
    expect_error(with(kCloth + R"(, "material": "slik")"), "/deformables/0/material",
                 "did you mean \"silk\"?");
    expect_error(with(R"("kind": "cloth", "shape": {"gird": {}})"), "/deformables/0/shape/gird",
                 "did you mean \"grid\"?");
    expect_error(with(R"("kind": "cloth", "shape": {})"), "/deformables/0/shape",
                 "exactly one key");
    expect_error(with(kCloth + "}, {" + kCloth), "/deformables/1",
                 "there is already a deformable named \"sheet\"");
}

TEST(Deformables, RefuseElementsThatAreWrong) {
    const auto refused = [](const std::string& keys, const std::string& place,
                            const std::string& words) {
        expect_error(with(keys), "/deformables/0" + place, words);
    };
    const std::string in_mesh = "/shape/mesh";
    const auto cloth = [](const std::string& triangles) {
        return mesh("cloth", kFour, "\"triangles\": " + triangles);
    };
    refused(cloth("[[0, 1, 4]]"), in_mesh + "/triangles/0",
            "triangle 0 has point 4, but there are only 4 points");
    refused(cloth("[[0, 1, 2], [0, 3, 3]]"), in_mesh + "/triangles/1",
            "triangle 1 has point 3 twice");
    refused(cloth("[[0, 1, 2]]"), in_mesh + "/points/3",
            "point 3 at (0, 0, 1) belongs to no triangle");
    refused(cloth("[]"), in_mesh + "/triangles", "there must be at least one triangle");
    refused(mesh("cloth", "[]", "\"triangles\": []"), in_mesh + "/points", "there are no points");
    refused(mesh("cloth", "[[0, 0, 0], [1, 0, 0], [2, 0, 0]]", "\"triangles\": [[0, 1, 2]]"),
            in_mesh + "/triangles/0", "triangle 0 has no area");
    refused(mesh("cloth", "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0], [0, -1, 0], [-1, 0, 0]]",
                 "\"triangles\": [[0, 1, 2], [3, 5, 4]]"),
            in_mesh + "/points/3", "point 3 at (0, 0, 0) lies where point 0 does");
    refused(mesh("cloth", "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, -1, -1]]",
                 "\"triangles\": [[0, 1, 2], [1, 0, 3], [0, 1, 4]]"),
            in_mesh + "/triangles/2",
            "more than two triangles meet in the edge from point 0 to point 1: 0, 1 and 2");
    refused(cloth("[[0, 1, 2], [0, 1, 3]]"), in_mesh + "/triangles/1",
            "triangles 0 and 1 run along the edge from point 0 to point 1 in the same direction");
    refused(mesh("rope", "[[0, 0, 0], [1, 0, 0]]", "\"segments\": [[0, 0]]"),
            in_mesh + "/segments/0", "segment 0 has point 0 twice");
    refused(mesh("rope", "[[0, 0, 0], [0, 0, 0]]", "\"segments\": [[0, 1]]"),
            in_mesh + "/segments/0", "segment 0 has no length");
    refused(mesh("rope", "[[0, 0, 0], [1, 0, 0]]", "\"triangles\": [[0, 1, 1]]"),
            in_mesh + "/triangles", "a rope is made of \"segments\", not of \"triangles\"");
    refused(mesh("cloth", kFour, "\"tetrahedra\": [[0, 1, 2, 3]]"), in_mesh + "/tetrahedra",
            "a cloth is made of \"triangles\"");
    refused(mesh("cloth", kFour, "\"scale\": 2, \"triangles\": []"), in_mesh + "/scale",
            "is for \"file\" alone");
    refused(R"("kind": "cloth", "shape": {"mesh": {"points": []}})", in_mesh,
            "\"triangles\" are missing");
    refused(R"("kind": "cloth", "shape": {"mesh": {}})", in_mesh,
            "must have either \"file\" or \"points\"");
}

TEST(Deformables, RefuseBalloonsAndSolidsThatHoldNothing) {
    const auto refused = [](const std::string& keys, const std::string& place,
                            const std::string& words) {
        expect_error(with(keys), "/deformables/0/shape/mesh" + place, words);
    };
    refused(mesh("balloon", kFour, "\"triangles\": [[0, 2, 1], [0, 1, 3], [0, 3, 2]]"),
            "/triangles/0",
            "the surface must be closed, but the edge from point 1 to point 2 belongs to triangle "
            "0 alone");
    expect_error(with(mesh("balloon", "[[0, 0, 0], [1, 0, 0], [0, 1, 0]]",
                           "\"triangles\": [[0, 1, 2], [0, 2, 1]]")),
                 "/deformables/0", "its surface is flat");
    const auto solid = [](const std::string& points, const std::string& tetrahedra) {
        return mesh("solid", points, "\"tetrahedra\": " + tetrahedra);
    };
    refused(solid(kFour, "[[0, 2, 1, 3]]"), "/tetrahedra/0",
            "tetrahedron 0 is turned inside out: seen from its fourth point");
    refused(solid("[[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]", "[[0, 1, 2, 3]]"),
            "/tetrahedra/0", "tetrahedron 0 has no volume");
    refused(solid(kFour, "[]"), "/tetrahedra", "there must be at least one tetrahedron");
    refused(solid("[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 2], [0, 0, 3]]",
                  "[[0, 1, 2, 3], [0, 1, 2, 4], [0, 1, 2, 5]]"),
            "/tetrahedra/2",
            "more than two tetrahedra meet in the face of points 0, 1 and 2: 0, 1 and 2");
}

TEST(Deformables, AreRepeatedOverAGrid) {
    const Scene scene = scene_of(R"({"deformables": [{
        "repeat": {"count": [2, 1, 2], "spacing": [3, 1, 5], "origin": [0, 7, 0]},
        "deformables": [{"name": "string", "kind": "rope", "position": [0, 1, 0],
                         "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0], "segments": 1}},
                         "attach": [{"near": {"point": [1, 1, 0], "radius": 0.1}}]}]}]})");
    ASSERT_EQ(scene.deformables.size(), 4u);
    ASSERT_EQ(scene.attachments.size(), 4u);
    for (std::uint32_t i = 0; i < 4; ++i) {
        EXPECT_EQ(scene.deformables[i].name, "string_000" + std::to_string(i + 1));
        EXPECT_EQ(scene.deformables[i].points[0], Eigen::Vector3d(3 * (i % 2), 8, 5 * (i / 2)));
        EXPECT_EQ(scene.attachments[i].deformable, i);
        EXPECT_EQ(scene.attachments[i].points, std::vector<std::uint32_t>{1});
    }
    const std::string grid = R"({"deformables": [{"repeat": {"count": [300, 300, 300]}, )";
    expect_error(grid + R"("deformables": [{"kind": "rope", "shape": {"line": {"from": [0, 0, 0],
                           "to": [1, 0, 0], "segments": 9999}}}]}]})",
                 "/deformables/0/repeat", "but a scene may have at most 1000000");
    expect_error(R"({"deformables": [{"repeat": {"count": [2, 1, 1], "spacing": [1e9, 0, 0]},
                     "deformables": [{"kind": "rope", "shape": {"line": {"from": [0, 0, 0],
                                      "to": [1, 0, 0]}}}]}]})",
                 "/deformables/0/deformables/0/shape", "lies further from the origin than 1e9 m");
    expect_error(grid + R"("deformables": []}]})", "/deformables/0/deformables",
                 "a list of at least one deformable");
    expect_error(grid + R"("deformables": [{"kind": "rop"}]}]})",
                 "/deformables/0/deformables/0/kind", "did you mean \"rope\"?");
}

TEST(Deformables, AreLimitedInNumber) {
    expect_error(
        with(R"("kind": "cloth", "shape": {"grid": {"cells": [1000, 1000], "size": [1, 1]}})"),
        "/deformables/0/shape/grid",
        "these are 1002001 points, but a scene may have at most 1000000");
    expect_error(with(R"("kind": "solid", "shape": {"sphere": {"radius": 1, "cells": 1000}})"),
                 "/deformables/0/shape/sphere", "but a scene may have at most 1000000");
    expect_error(
        with(
            R"("kind": "solid", "shape": {"lattice": {"size": [1, 1, 1], "cells": [10000, 10000, 10000]}})"),
        "/deformables/0/shape/lattice", "but a scene may have at most 1000000");
    expect_error(
        with(
            R"("kind": "solid", "shape": {"lattice": {"size": [1, 1, 1], "cells": [79, 79, 79], "tetrahedra": "body_centered"}})"),
        "/deformables/0/shape/lattice", "these are 1005039 points");
}

TEST(Deformables, AreCutAsTold) {
    const auto points = [](const std::string& keys) {
        return scene_of(with(R"("kind": "solid", "shape": {"lattice": {"size": [1, 1, 1], )" +
                             keys + "}}"))
            .deformables[0]
            .points.size();
    };
    const std::string one = R"("cells": [1, 1, 1])";
    EXPECT_EQ(points(one), 8u);
    EXPECT_EQ(points(one + R"(, "tetrahedra": "five")"), 8u);
    EXPECT_EQ(points(one + R"(, "tetrahedra": "body_centered")"), 9u);
    expect_error(
        with(
            R"("kind": "solid", "shape": {"lattice": {"size": [1, 1, 1], "tetrahedra": "body_centred"}})"),
        "/deformables/0/shape/lattice/tetrahedra", "did you mean \"body_centered\"?");
}

}  // namespace plumb::test
