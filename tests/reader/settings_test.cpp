// SPDX-License-Identifier: MIT
#include "reading.h"

namespace plumb::test {

namespace {

Settings settings_of(const std::string& keys) {
    return scene_of("{\"settings\": {" + keys + "}}").settings;
}

/// What `apply_setting` says.
std::string set_error(const std::string& setting) {
    Settings settings;
    try {
        apply_setting(settings, setting);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST(Settings, FillsEveryMember) {
    const Settings s =
        settings_of(R"("gravity": [1, 2, 3], "wind": [4, 0, -1], "gusts": [0.5, 0, 2],
        "gust_period": 2.5, "air_density": 1.1, "dt": 0.02, "duration": 3, "substeps": 4,
        "velocity_iterations": 0, "position_iterations": 7, "method": "pbd", "precision": "double", "threads": 8,
        "lanes": 16, "margin": 0.1, "stiffness": 0.3, "recovery_speed": 2, "collision_depth": 0.001,
        "anchor_stiffness": 0.5, "gyroscopic": "implicit", "warm_start": false, "alternate_sweeps": false,
        "shared_cone": false, "leapfrog_start": true, "shared_push": false, "joints": "tree",
        "exact_islands": 12, "accuracy": 0.02, "exact_deformables": 30, "multilevel": true, "tree_parts": 9, "sleep_speed": 0.02, "sleep_time": 0.7, "contacts": "raw", "joint_tolerance": 1e-6, "require": ["a", "b"], "forbid": ["c"])");
    EXPECT_EQ(s.gravity, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(s.wind, Eigen::Vector3d(4, 0, -1));
    EXPECT_EQ(s.gusts, Eigen::Vector3d(0.5, 0, 2));
    EXPECT_EQ(s.gust_period, 2.5);
    EXPECT_EQ(s.air_density, 1.1);
    EXPECT_EQ(s.dt, 0.02);
    EXPECT_EQ(s.duration, 3);
    EXPECT_EQ(s.substeps, 4u);
    EXPECT_EQ(s.velocity_iterations, 0u);
    EXPECT_EQ(s.position_iterations, 7u);
    EXPECT_EQ(s.precision, Precision::double_);
    EXPECT_EQ(s.threads, 8u);
    EXPECT_EQ(s.lanes, 16u);
    EXPECT_EQ(s.margin, 0.1);
    EXPECT_EQ(s.stiffness, 0.3);
    EXPECT_EQ(s.recovery_speed, 2);
    EXPECT_EQ(s.collision_depth, 0.001);
    EXPECT_EQ(s.anchor_stiffness, 0.5);
    EXPECT_EQ(s.gyroscopic, Gyroscopic::implicit);
    EXPECT_FALSE(s.warm_start);
    EXPECT_FALSE(s.alternate_sweeps);
    EXPECT_TRUE(s.leapfrog_start);
    EXPECT_FALSE(s.shared_cone);
    EXPECT_FALSE(s.shared_push);
    EXPECT_EQ(s.joints, JointMethod::tree);
    EXPECT_EQ(s.exact_islands, 12u);
    EXPECT_EQ(s.accuracy, 0.02);
    EXPECT_EQ(s.exact_deformables, 30u);
    EXPECT_TRUE(s.multilevel);
    EXPECT_EQ(s.sleep_speed, 0.02);
    EXPECT_EQ(s.sleep_time, 0.7);
    EXPECT_EQ(s.tree_parts, 9u);
    EXPECT_EQ(s.contacts, ContactOrigin::raw);
    EXPECT_EQ(s.joint_tolerance, 1e-6);
    EXPECT_EQ(s.require, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(s.forbid, (std::vector<std::string>{"c"}));
}

TEST(Settings, PresetComesFirstWhereverItStands) {
    const Settings s = settings_of(R"("warm_start": true, "preset": "paper")");
    EXPECT_TRUE(s.warm_start);
    EXPECT_FALSE(s.shared_cone);
    EXPECT_EQ(s.anchor_stiffness, 0);
    EXPECT_EQ(s.gyroscopic, Gyroscopic::explicit_);
    EXPECT_EQ(s.joints, JointMethod::iterate);
}

TEST(Settings, RefusesWhatIsOutOfRange) {
    const std::vector<std::pair<std::string, std::string>> bad = {
        {"dt", "0"},          {"dt", "-0.01"},
        {"dt", "true"},       {"substeps", "0"},
        {"substeps", "1.5"},  {"threads", "0"},
        {"lanes", "2"},       {"lanes", "\"4\""},
        {"margin", "-1"},     {"stiffness", "2"},
        {"duration", "-1"},   {"velocity_iterations", "100001"},
        {"gravity", "[0,1]"}, {"require", "\"a\""},
        {"dt", "null"},       {"position_iterations", "-1"},
        {"wind", "3"},        {"wind", "[0, 1e5]"},
        {"gust_period", "0"}, {"air_density", "-1"}};
    for (const auto& [key, value] : bad) {
        expect_error("{\"settings\": {\"" + key + "\": " + value + "}}", "/settings/" + key,
                     "must be");
    }
}

TEST(Settings, KnowsItsWords) {
    expect_error(R"({"settings": {"precision": "duoble"}})", "/settings/precision",
                 "did you mean \"double\"?");
    expect_error(R"({"settings": {"gyroscopic": "exact"}})", "/settings/gyroscopic",
                 "Allowed: conserving, implicit, explicit");
    expect_error(R"({"settings": {"contacts": "rwa"}})", "/settings/contacts",
                 "did you mean \"raw\"?");
    expect_error(R"({"settings": {"contacts": "clipped"}})", "/settings/contacts",
                 "Allowed: shared, raw");
    expect_error(R"({"settings": {"method": "pdb"}})", "/settings/method", "did you mean \"pbd\"?");
}

TEST(Settings, NamesTheKeyThatWasMeant) {
    expect_error(R"({"settings": {"wnid": [1, 0, 0]}})", "/settings/wnid",
                 "did you mean \"wind\"?");
    expect_error(R"({"settings": {"wind": [1, "2", 0]}})", "/settings/wind/1", "must be");
    EXPECT_FALSE(settings_of("").wind.has_value()) << "no air unless there is a wind";
}

TEST(ApplySetting, TakesLooseValues) {
    Settings s;
    apply_setting(s, "wind=3,0,1");
    EXPECT_EQ(s.wind, Eigen::Vector3d(3, 0, 1));
    apply_setting(s, "duration=.5");
    EXPECT_EQ(s.duration, 0.5);
    apply_setting(s, "dt=0.005");
    apply_setting(s, "precision=double");
    apply_setting(s, "warm_start=false");
    apply_setting(s, "gravity=0,-1.5,0");
    apply_setting(s, "require=shock_propagation,joints");
    EXPECT_EQ(s.dt, 0.005);
    EXPECT_EQ(s.precision, Precision::double_);
    EXPECT_FALSE(s.warm_start);
    EXPECT_EQ(s.gravity, Eigen::Vector3d(0, -1.5, 0));
    EXPECT_EQ(s.require, (std::vector<std::string>{"shock_propagation", "joints"}));
    apply_setting(s, "gravity=[1,2,3]");
    apply_setting(s, "require=");
    EXPECT_EQ(s.gravity, Eigen::Vector3d(1, 2, 3));
    EXPECT_TRUE(s.require.empty());
}

TEST(ApplySetting, ChecksAsAFileIsChecked) {
    EXPECT_NE(set_error("subtseps=2").find("did you mean \"substeps\"?"), std::string::npos);
    EXPECT_NE(set_error("dt=0").find("must be a number above 0"), std::string::npos);
    EXPECT_NE(set_error("dt=nan").find("the text \"nan\""), std::string::npos);
    EXPECT_NE(set_error("dt").find("must be key=value"), std::string::npos);
    EXPECT_NE(set_error("=3").find("must be key=value"), std::string::npos);
    EXPECT_NE(set_error("dt=").find("must be a number"), std::string::npos);
}

TEST(ApplySetting, LeavesSettingsAloneWhenTheValueIsBad) {
    Settings s;
    EXPECT_THROW(apply_setting(s, "gravity=1,2"), SceneError);
    EXPECT_EQ(s.gravity, Settings{}.gravity);
}

}  // namespace plumb::test
