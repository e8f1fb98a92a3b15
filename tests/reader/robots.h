// SPDX-License-Identifier: MIT
/// Help for the tests of URDF files: small robots from text, and what an error says.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "reader/reader.h"
#include "reader/robots/robot.h"

namespace plumb::test {

/// A folder of its own, with robots and meshes in it, gone at the end of the test.
class Robots : public ::testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "plumb-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string& name, const std::string& content) const {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return folder_ / name;
    }

    /// The scene of a robot's elements alone: no ground, and not lifted.
    Scene scene_of(const std::string& elements, const RobotOptions& options = {}) const {
        Scene scene;
        add_robot(scene, write("robot.urdf", robot(elements)), options);
        return scene;
    }

    /// What adding a robot complains of, which must name the file.
    std::string error_of_text(const std::string& text, const RobotOptions& options = {}) const {
        const std::filesystem::path file = write("robot.urdf", text);
        try {
            Scene scene;
            add_robot(scene, file, options);
        } catch (const SceneError& error) {
            EXPECT_EQ(error.file(), file.string());
            return error.what();
        }
        return "no error";
    }
    std::string error_of(const std::string& elements, const RobotOptions& options = {}) const {
        return error_of_text(robot(elements), options);
    }

    static std::string robot(const std::string& elements) {
        return "<robot name=\"r\">" + elements + "</robot>";
    }

    /// A link with a mass, the moments 1 2 2.5, and more.
    static std::string link(const std::string& name, const std::string& more = "") {
        return "<link name=\"" + name + "\">" + inertial("1 2 2.5", "2", "0 0 0") + more +
               "</link>";
    }

    static std::string inertial(const std::string& moments, const std::string& mass,
                                const std::string& centre, const std::string& rpy = "0 0 0") {
        std::istringstream words(moments);
        std::string x, y, z;
        words >> x >> y >> z;
        return "<inertial><origin xyz=\"" + centre + "\" rpy=\"" + rpy + "\"/><mass value=\"" +
               mass + "\"/><inertia ixx=\"" + x + "\" ixy=\"0\" ixz=\"0\" iyy=\"" + y +
               "\" iyz=\"0\" izz=\"" + z + "\"/></inertial>";
    }

    static std::string collision(const std::string& shape, const std::string& origin = "") {
        return "<collision>" + origin + "<geometry>" + shape + "</geometry></collision>";
    }

    /// A joint from `parent` to `child`, both of one letter.
    static std::string joint(const std::string& type, const std::string& parent,
                             const std::string& child, const std::string& more = "") {
        return "<joint name=\"" + parent + child + "\" type=\"" + type + "\"><parent link=\"" +
               parent + "\"/><child link=\"" + child + "\"/>" + more + "</joint>";
    }

    static inline const std::string kLimit =
        R"(<limit lower="-1" upper="2" effort="30" velocity="4"/>)";

    std::filesystem::path folder_;
};

/// The body of a name; fails the test where there is none.
inline const BodySpec& body(const Scene& scene, const std::string& name) {
    for (const BodySpec& b : scene.bodies) {
        if (b.name == name) return b;
    }
    ADD_FAILURE() << "no body " << name;
    static const BodySpec none;
    return none;
}

inline void expect_near(const Eigen::Vector3d& is, const Eigen::Vector3d& wanted,
                        double tolerance = 1e-12) {
    EXPECT_LE((is - wanted).cwiseAbs().maxCoeff(), tolerance) << is.transpose();
}

inline void expect_words(const std::string& sentence, const std::string& words) {
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
}

}  // namespace plumb::test
