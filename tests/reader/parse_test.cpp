// SPDX-License-Identifier: MIT
#include "reading.h"

namespace plumb::test {

TEST(Parse, TakesComments) {
    const Scene scene = scene_of("// a scene\n{ /* its name */ \"name\": \"x // y\" }");
    EXPECT_EQ(scene.name, "x // y");
}

TEST(Parse, NamesLineAndColumn) {
    expect_error("{\n  \"name\": \"x\",\n  \"bodies\" [] }", "", "line 3, column 12");
    expect_error("{", "", "line 1, column 2");
    expect_error("", "", "unexpected end of input");
}

TEST(Parse, RefusesNumbersThatAreNotFinite) {
    for (const std::string number : {"NaN", "nan", "Infinity", "-Infinity", "inf", "-NaN"}) {
        expect_error("{\"settings\": {\"dt\": " + number + "}}", "",
                     "JSON has no NaN and no infinity");
    }
    expect_error(R"({"settings": {"dt": 1e999}})", "", "1e999");
    expect_error(R"({"settings": {"dt": "NaN"}})", "/settings/dt", "is the text \"NaN\"");
}

TEST(Parse, RefusesAKeyThatStandsTwice) {
    expect_error(R"({"bodies": [{"name": "a"}, {"mass": 1, "mass": 1}]})", "/bodies/1/mass",
                 "twice");
    expect_error(R"({"shapes": {"a/b~": {"sphere": {"radius": 1, "radius": 1}}}})",
                 "/shapes/a~1b~0/sphere/radius", "twice");
}

TEST(Parse, RefusesDepthWithoutEnd) {
    expect_error(std::string(100000, '['), "", "too deep");
    expect_error("{\"name\": " + std::string(70, '[') + std::string(70, ']') + "}", "", "too deep");
}

TEST(Parse, RefusesWhatIsNoObject) {
    expect_error("[1, 2]", "", "must be an object, but is a list of 2");
    expect_error("\xff\xfe", "", "line 1, column 1");
}

TEST(Parse, KnowsOnlyItsKeys) {
    expect_error(R"({"bodis": []})", "/bodis", "did you mean \"bodies\"?");
    expect_error(R"({"settings": {"substep": 2}})", "/settings/substep",
                 "did you mean \"substeps\"?");
}

TEST(Parse, NamesFilesThatCannotBeRead) {
    for (const char* file : {"/no/such/file.json", PLUMB_SAMPLES}) {
        try {
            read_scene(file);
            FAIL() << file;
        } catch (const SceneError& error) {
            EXPECT_EQ(error.file(), file);
        }
    }
}

TEST(Parse, ShowsControlCharactersOfKeys) {
    expect_error(R"({"vi\u0000ew": 1})", "/vi\\u0000ew", R"(unknown key "vi\u0000ew")");
    expect_error(R"({"view\n": 1})", "/view\\u000a", "did you mean \"view\"?");
}

}  // namespace plumb::test
