// SPDX-License-Identifier: MIT
/// The collider that a scene gets when none is named, from made-up tables.
#include "host/choose_collider.h"

#include "host/shape_pairs.h"

#include <gtest/gtest.h>

#include <deque>

namespace plumb::test {
namespace {

constexpr auto kPlane = ShapeKind::plane, kSphere = ShapeKind::sphere, kBox = ShapeKind::box;

/// Tables that live as long as the test.
struct Plugins {
    std::deque<PluginTable> tables;
    std::vector<ColliderInfo> infos;

    /// A plugin that can do all pairs of all kinds, at one cost [ns].
    PluginTable& add(const char* name, std::uint32_t cost, const char* precision = "double") {
        PluginTable& t = tables.emplace_back();
        t.name = name;
        t.precision = precision;
        for (auto& row : t.pairs)
            for (auto& pair : row) pair = kPairManifold;
        for (auto& row : t.costs)
            for (auto& pair : row) pair = cost;
        infos.push_back({{}, &t, name, {}});
        return t;
    }

    std::string chosen(const Scene& scene) const {
        const ColliderChoice choice = choose_collider(infos, scene);
        return choice.collider ? choice.collider->name + ": " + choice.reason : "none";
    }
};

void set(std::uint32_t (&table)[kShapeKindCount][kShapeKindCount], ShapeKind a, ShapeKind b,
         std::uint32_t value) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    table[i][j] = table[j][i] = value;
}

void add_bodies(Scene& scene, ShapeKind kind, int count, Motion motion = Motion::dynamic) {
    Geometry geometry;
    geometry.kind = kind;
    scene.geometries.push_back(geometry);
    BodySpec body;
    body.geometry = static_cast<std::uint32_t>(scene.geometries.size() - 1);
    body.motion = motion;
    for (int i = 0; i < count; ++i) scene.bodies.push_back(body);
}

/// Boxes and spheres on a plane.
Scene boxes_and_spheres(int boxes, int spheres) {
    Scene scene;
    add_bodies(scene, kPlane, 1, Motion::fixed);
    add_bodies(scene, kBox, boxes);
    add_bodies(scene, kSphere, spheres);
    return scene;
}

double near_of(const Scene& scene, ShapeKind a, ShapeKind b) {
    for (const ShapePairNeed& need : shape_pair_needs(scene))
        if (need.a == a && need.b == b) return need.near;
    return -1;
}

TEST(ChooseCollider, TakesTheCheapestAndSaysSo) {
    Plugins plugins;
    plugins.add("dear", 800);
    plugins.add("cheap", 200);
    plugins.add("middling", 400);
    EXPECT_EQ(
        plugins.chosen(boxes_and_spheres(10, 10)),
        "cheap: supports all 5 pairs of shapes, about 0.5 of middling's cost, 0.25 of dear's");
}

TEST(ChooseCollider, WeighsPairsByHowManyBodiesThereAre) {
    Plugins plugins;
    set(plugins.add("round", 300).costs, kSphere, kSphere, 30);
    set(plugins.add("square", 300).costs, kBox, kBox, 30);
    EXPECT_EQ(plugins.chosen(boxes_and_spheres(10, 90)).substr(0, 5), "round");
    EXPECT_EQ(plugins.chosen(boxes_and_spheres(90, 10)).substr(0, 6), "square");
}

TEST(ChooseCollider, TakesNoneThatLacksAPair) {
    Plugins plugins;
    set(plugins.add("lacking", 1).pairs, kBox, kSphere, kPairNone);
    plugins.add("able", 1000);
    EXPECT_EQ(plugins.chosen(boxes_and_spheres(2, 2)),
              "able: supports all 5 pairs of shapes, as no other does");
    EXPECT_EQ(plugins.chosen(boxes_and_spheres(2, 0)).substr(0, 8), "lacking:")
        << "the pair cannot occur";

    Plugins lacking;
    set(lacking.add("lacking", 1).pairs, kBox, kSphere, kPairNone);
    EXPECT_EQ(lacking.chosen(boxes_and_spheres(1, 1)), "none");
}

TEST(ChooseCollider, TakesMovingMeshesOnlyWhereTheyAreClaimed) {
    Scene scene = boxes_and_spheres(3, 0);
    add_bodies(scene, ShapeKind::mesh, 1, Motion::kinematic);
    Plugins plugins;
    plugins.add("still", 1);
    PluginTable& moving = plugins.add("moving", 1000);
    set(moving.pairs, kBox, ShapeKind::mesh, kPairManifold | kPairMovingMesh);
    EXPECT_EQ(plugins.chosen(scene).substr(0, 7), "moving:");
}

TEST(ChooseCollider, RanksUnknownCostsBehindKnownOnesByName) {
    Plugins plugins;
    plugins.add("b_unknown", 0);
    set(plugins.add("a_half_known", 1).costs, kPlane, kBox, 0);
    EXPECT_EQ(plugins.chosen(boxes_and_spheres(5, 5)),
              "a_half_known: supports all 5 pairs of shapes; what it costs is not known");
    EXPECT_EQ(plugins.chosen(Scene{}).substr(0, 12), "a_half_known");
    plugins.add("known", 100000);
    EXPECT_EQ(plugins.chosen(boxes_and_spheres(5, 5)), "known: supports all 5 pairs of shapes");
}

TEST(ChooseCollider, TakesTheYardstickOnlyWhereNoOtherCan) {
    Plugins plugins;
    plugins.add("reference", 1);
    EXPECT_EQ(plugins.chosen(boxes_and_spheres(1, 0)),
              "reference: supports the only pair of shapes, as no other "
              "does");
    plugins.add("zebra", 0, "single");
    EXPECT_EQ(plugins.chosen(boxes_and_spheres(1, 0)).substr(0, 6), "zebra:");
}

TEST(ChooseCollider, DoesNotPayWithPrecision) {
    Plugins plugins;
    plugins.add("rough", 1, "single");
    plugins.add("fine", 100, "double");
    EXPECT_EQ(plugins.chosen(boxes_and_spheres(5, 5)).substr(0, 5), "fine:");
}

TEST(ChooseCollider, SkipsRefusedFilesAndScenesWithoutPairs) {
    Plugins plugins;
    plugins.infos.push_back({{}, nullptr, "refused", "it is junk"});
    EXPECT_EQ(plugins.chosen(boxes_and_spheres(1, 1)), "none");
    plugins.add("able", 7);
    EXPECT_EQ(plugins.chosen(Scene{}), "able: the scene has no pairs of shapes that could touch");
}

TEST(ShapePairs, EstimatesHowManyAreNearEachOther) {
    // Each of two boxes may stand on the plane, and they may touch each other.
    EXPECT_DOUBLE_EQ(near_of(boxes_and_spheres(2, 0), kPlane, kBox), 2);
    EXPECT_DOUBLE_EQ(near_of(boxes_and_spheres(2, 0), kBox, kBox), 1);
    // In a heap each of 200 has six neighbours, which makes 600 pairs in all.
    const Scene heaped = boxes_and_spheres(100, 100);
    const double boxes = near_of(heaped, kBox, kBox), spheres = near_of(heaped, kSphere, kSphere),
                 mixed = near_of(heaped, kSphere, kBox);
    EXPECT_NEAR(boxes + spheres + mixed, 600, 1e-9);
    EXPECT_NEAR(mixed, 600 * 100.0 / 199, 1e-9);
    EXPECT_DOUBLE_EQ(near_of(heaped, kPlane, kSphere), 100);
    // Half of twice as many surfaces are stood on as often.
    Scene two = boxes_and_spheres(10, 0);
    add_bodies(two, ShapeKind::mesh, 1, Motion::fixed);
    EXPECT_DOUBLE_EQ(near_of(two, kPlane, kBox), 5);
    EXPECT_DOUBLE_EQ(near_of(two, kBox, ShapeKind::mesh), 5);
}

TEST(ShapePairs, CountsThePartsOfCompounds) {
    Scene scene;
    Geometry part, compound;
    part.kind = kBox;
    compound.kind = ShapeKind::compound;
    compound.parts.assign(3, {part, {}});
    scene.geometries = {compound};
    BodySpec body;
    body.geometry = 0;
    scene.bodies = {body};
    add_bodies(scene, kPlane, 1, Motion::fixed);
    EXPECT_DOUBLE_EQ(near_of(scene, kPlane, kBox), 3);
    EXPECT_EQ(near_of(scene, kBox, kBox), -1) << "a body does not meet itself";
    scene.bodies.push_back(body);
    EXPECT_DOUBLE_EQ(near_of(scene, kBox, kBox), 9) << "each of three with each of three";
}

}  // namespace
}  // namespace plumb::test
