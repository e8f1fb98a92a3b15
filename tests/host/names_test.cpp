// SPDX-License-Identifier: MIT
/// Bodies, joints, materials and deformables by name.
#include "host/editing.h"

namespace plumb::test {
namespace {

TEST(Names, LeadToWhatIsCalledSo) {
    Scene s;
    s.materials.push_back({"rubber", 900, 0.9, 0, 0, 0});
    add_ground(s);
    s.bodies[0].name = "ground";
    for (int i = 0; i < 3; ++i) add_body(s, box(0.1, 0.1, 0.1), {0, 1.0 + i, 0}).name = "crate";
    JointSpec hinge;
    hinge.name = "door", hinge.kind = JointKind::hinge, hinge.body_a = 2;
    s.joints.push_back(hinge);
    DeformableSpec rope;
    rope.name = "rope", rope.kind = DeformableKind::rope;
    rope.points = {{3, 1, 0}, {3, 2, 0}}, rope.segments = {{0, 1}};
    s.deformables.push_back(rope);
    Simulation simulation(s, colliders(), "reference");
    EXPECT_EQ(simulation.find_body("ground"), 0u);
    EXPECT_EQ(simulation.find_body("crate"), 1u);
    EXPECT_EQ(simulation.find_body("crates"), std::nullopt);
    EXPECT_EQ(simulation.find_body(""), std::nullopt);
    EXPECT_EQ(simulation.find_joint("door"), 0u);
    EXPECT_EQ(simulation.find_material("rubber"), 1u);
    EXPECT_EQ(simulation.find_deformable("rope"), 0u);
    EXPECT_EQ(simulation.find_deformable("door"), std::nullopt);

    simulation.remove_body(1);
    EXPECT_EQ(simulation.find_body("crate"), 2u);
    BodySpec lid;
    lid.name = "lid", lid.geometry = 1, lid.placement.position = {0, 9, 0};
    const std::uint32_t id = simulation.add_body(lid);
    EXPECT_EQ(simulation.find_body("lid"), id);
    hinge.name = "flap", hinge.body_a = id;
    EXPECT_EQ(simulation.find_joint("flap"), simulation.add_joint(hinge));
    simulation.remove_body(id);
    EXPECT_EQ(simulation.find_body("lid"), std::nullopt);
    EXPECT_EQ(simulation.find_joint("flap"), std::nullopt);
}

}  // namespace
}  // namespace plumb::test
