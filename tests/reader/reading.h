// SPDX-License-Identifier: MIT
/// Help for the tests of the reader: scenes from text, and what an error says.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "reader/reader.h"

namespace plumb::test {

/// The scene of a text that stands where the sample scenes stand, so that meshes are found.
inline Scene scene_of(std::string_view text) {
    return parse_scene(text, PLUMB_SAMPLES "/scenes/test.json");
}

/// What reading a text throws: the error, or one whose parts are "no error".
inline SceneError error_of(std::string_view text) {
    try {
        scene_of(text);
    } catch (const SceneError& error) {
        return error;
    }
    return SceneError("no error", "no error", "no error");
}

/// A scene with one body, whose keys are given: `"mass": 2`.
inline std::string with_body(const std::string& keys) {
    return R"({"bodies": [{"shape": {"sphere": {"radius": 1}}, )" + keys + "}]}";
}

/// A scene with one fixed body of a shape.
inline std::string with_shape(const std::string& shape) {
    return R"({"bodies": [{"motion": "fixed", "shape": )" + shape + "}]}";
}

/// Expects an error at a place, whose sentence has certain words.
inline void expect_error(const std::string& text, const std::string& pointer,
                         const std::string& words) {
    const SceneError error = error_of(text);
    EXPECT_EQ(error.pointer(), pointer) << error.what();
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    EXPECT_NE(error.file().find("test.json"), std::string::npos) << error.what();
}

}  // namespace plumb::test
