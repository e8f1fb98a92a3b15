// SPDX-License-Identifier: MIT
#include "output/exporters.h"

#include "falling.h"
#include "output/error.h"
#include "temporary_folder.h"

namespace plumb::test {
namespace {

class ExportersTest : public TemporaryFolder {
protected:
    std::string sentence(const std::string& file) {
        try {
            make_exporter(file, falling_scene(1), {});
        } catch (const OutputError& error) {
            return error.what();
        }
        return "nothing was thrown";
    }
};

TEST_F(ExportersTest, UnknownEndingNamesTheNearest) {
    EXPECT_EQ(sentence("run.htm"),
              "run.htm: has the ending .htm, which is none of .html, .png, .csv, .plumb; "
              "did you mean .html?");
    EXPECT_NE(sentence("run.plum").find("did you mean .plumb?"), std::string::npos);
    EXPECT_NE(sentence("run.cvs").find("did you mean .csv?"), std::string::npos);
    EXPECT_EQ(sentence("some.dir/run"),
              "some.dir/run: has no ending; it must be one of .html, .png, .csv, .plumb");
}

class EveryEnding : public ExportersTest, public testing::WithParamInterface<const char*> {};

TEST_P(EveryEnding, PathThatCannotBeWrittenIsKnownBeforeTheRun) {
    const std::string file = path("missing/run") + GetParam();
    const std::string said = sentence(file);
    EXPECT_EQ(said.find(file), 0u) << said;
    EXPECT_NE(said.find("No such file or directory"), std::string::npos) << said;

    std::filesystem::create_directory(path("folder") + GetParam());
    EXPECT_NE(sentence(path("folder") + GetParam()).find("Is a directory"), std::string::npos);
}

TEST_P(EveryEnding, FileIsWrittenAndNothingIsLeftBeside) {
    const Scene scene = falling_scene(9);
    std::filesystem::create_directory(path("only"));
    const std::string file = path("only/run") + GetParam();
    const auto exporter = make_exporter(file, scene, {"bullet", {}});
    exporter->append(falling_frame(scene, 0, 0));
    exporter->append(falling_frame(scene, 1, 0.1));
    exporter->finish();
    EXPECT_GT(std::filesystem::file_size(file), 500u);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path("only"))) {
        ++files;
        EXPECT_EQ(entry.path().string(), file);
    }
    EXPECT_EQ(files, 1u);
}

TEST_P(EveryEnding, RunWithoutFramesStillMakesAFile) {
    const std::string file = path("empty") + GetParam();
    make_exporter(file, Scene{}, {})->finish();
    EXPECT_GT(std::filesystem::file_size(file), 20u);
}

/// Bodies that came, went, or changed places: a file of one scene's bodies would tell a lie.
TEST_P(EveryEnding, FramesOfOtherBodiesAreRefused) {
    const Scene scene = falling_scene(1);
    const auto exporter = make_exporter(path("edited") + GetParam(), scene, {});
    Frame frame = falling_frame(scene, 0, 0);
    for (std::uint32_t i = 0; i < frame.bodies.size(); ++i) frame.ids.push_back(i);
    exporter->append(frame);
    Frame vacant = frame, reused = frame, more = frame, fewer = frame;
    vacant.ids[1] = kNoIndex;
    reused.ids[1] = static_cast<std::uint32_t>(frame.bodies.size());
    more.bodies.push_back(frame.bodies[0]), more.ids.push_back(reused.ids[1]);
    fewer.bodies.pop_back(), fewer.ids.pop_back();
    for (const Frame* other : {&vacant, &reused, &more, &fewer}) {
        try {
            exporter->append(*other);
            FAIL() << "it took the frame";
        } catch (const OutputError& error) {
            EXPECT_NE(std::string(error.what()).find("added or removed"), std::string::npos)
                << error.what();
        }
    }
    EXPECT_NO_THROW(exporter->append(frame));
}

INSTANTIATE_TEST_SUITE_P(Endings, EveryEnding, testing::Values(".html", ".png", ".csv", ".plumb"));

TEST_F(ExportersTest, OldFileStaysWhenARunIsBrokenOff) {
    for (const std::string name : {"old.html", "old.png"}) {
        write(name, "old");
        const Scene scene = falling_scene(1);
        {
            const auto exporter = make_exporter(path(name), scene, {});
            exporter->append(falling_frame(scene, 0, 0));
        }
        EXPECT_EQ(read_file(path(name)), "old");
        EXPECT_FALSE(std::filesystem::exists(path(name + ".partial")));
    }
}

TEST_F(ExportersTest, RecordingBecomesAnyOtherFile) {
    const Scene scene = falling_scene(4);
    const auto exporter = make_exporter(path("run.plumb"), scene, {});
    for (std::uint64_t i = 0; i < 3; ++i) exporter->append(falling_frame(scene, i, 0.1 * i));
    exporter->finish();

    const Recording recording = read_recording(path("run.plumb"));
    export_recording(path("run.csv"), recording);
    const std::string csv = read_file(path("run.csv"));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'),
              1 + 3 * static_cast<int>(scene.bodies.size()));
    export_recording(path("again.plumb"), recording);
    EXPECT_EQ(read_recording(path("again.plumb")).frames.size(), 3u);
}

}  // namespace
}  // namespace plumb::test
