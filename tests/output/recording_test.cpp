// SPDX-License-Identifier: MIT
#include "output/recording.h"

#include "falling.h"
#include "math/bytes.h"
#include "output/error.h"
#include "output/exporters.h"
#include "output/rotation_code.h"
#include "temporary_folder.h"

#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>
#include <csignal>
#include <fstream>
#include <iterator>
#include <limits>

namespace plumb::test {
namespace {

std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class RecordingTest : public TemporaryFolder {
protected:
    /// Size of the file after the header and after each frame [bytes].
    std::vector<std::size_t> record(const Scene& scene, int frames) {
        RecordingWriter writer(path("run.plumb"), scene, {"fcl", {{"host", "here"}}});
        std::vector<std::size_t> sizes{std::filesystem::file_size(path("run.plumb"))};
        for (int i = 0; i < frames; ++i) {
            writer.append(falling_frame(scene, static_cast<std::uint64_t>(3 * i), 0.03 * i));
            sizes.push_back(std::filesystem::file_size(path("run.plumb")));
        }
        writer.close();
        return sizes;
    }
};

void expect_near(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double bound) {
    EXPECT_LE((a - b).cwiseAbs().maxCoeff(), bound);
}

double as_float(double x) { return static_cast<double>(static_cast<float>(x)); }

/// Half a unit in the last place of a float of this size.
double float_bound(double size) {
    return std::max(size, 1e-30) * static_cast<double>(std::numeric_limits<float>::epsilon());
}

TEST_F(RecordingTest, FramesComeBackWithinTheFormatsBounds) {
    Scene scene = falling_scene(20);
    for (BodySpec& body : scene.bodies) body.placement.position.x() += 1e6;  // far from the origin
    RecordingWriter writer(path("far.plumb"), scene, {});
    std::vector<Frame> frames;
    for (int i = 0; i < 5; ++i) {
        frames.push_back(falling_frame(scene, static_cast<std::uint64_t>(i), 0.1 * i));
        for (BodyState& body : frames.back().bodies) body.placement.position.x() += 1e6;
        writer.append(frames.back());
    }
    writer.close();

    const Recording recording = read_recording(path("far.plumb"));
    ASSERT_EQ(recording.frames.size(), frames.size());
    EXPECT_EQ(recording.dropped_bytes, 0u);
    for (std::size_t f = 0; f < frames.size(); ++f) {
        EXPECT_EQ(recording.frames[f].step, frames[f].step);
        EXPECT_EQ(recording.frames[f].time, frames[f].time);
        EXPECT_EQ(recording.frames[f].contacts, frames[f].contacts);
        EXPECT_EQ(recording.frames[f].kinetic_energy, frames[f].kinetic_energy);
        EXPECT_EQ(recording.frames[f].potential_energy, frames[f].potential_energy);
        EXPECT_EQ(recording.frames[f].deepest_penetration, frames[f].deepest_penetration);
        const FrameResidual &told = frames[f].residual, &read = recording.frames[f].residual;
        EXPECT_EQ(read.force_of_weight, as_float(told.force_of_weight));
        EXPECT_EQ(read.force, as_float(told.force));
        EXPECT_EQ(read.error, as_float(told.error));
        ASSERT_EQ(recording.frames[f].bodies.size(), frames[f].bodies.size());
        for (std::size_t i = 2; i < frames[f].bodies.size(); ++i) {
            const BodyState &a = frames[f].bodies[i], &b = recording.frames[f].bodies[i];
            const double size = (a.placement.position - recording.header.origin).norm();
            expect_near(a.placement.position, b.placement.position, float_bound(size) + 1e-9);
            EXPECT_LE(a.placement.rotation.angularDistance(b.placement.rotation),
                      rotation_error_bound(kRecordedRotationBits));
            expect_near(a.velocity, b.velocity, float_bound(a.velocity.norm()));
            expect_near(a.angular_velocity, b.angular_velocity,
                        float_bound(a.angular_velocity.norm()));
        }
    }
}

TEST_F(RecordingTest, HeaderComesBackWhole) {
    Scene scene = falling_scene(12);
    scene.name = "a \"name\" </script> \n\xc3\xa4";
    scene.view = View{{1, 2, 3}, {4, 5, 6}, 33};
    scene.settings.gravity = {0, 0, -1.6};
    scene.bodies[3].color = 0x123456;
    scene.bodies[4].geometry = kNoIndex;
    const Metadata metadata{"ode", {{"threads", "2"}, {"note", "x"}}};
    RecordingWriter(path("run.plumb"), scene, metadata).close();

    const RecordingHeader header = read_recording(path("run.plumb")).header;
    EXPECT_EQ(header.name, scene.name);
    EXPECT_EQ(header.description, scene.description);
    EXPECT_EQ(header.method, "pbd");
    EXPECT_EQ(header.dt, scene.settings.dt);
    EXPECT_EQ(header.gravity, scene.settings.gravity);
    EXPECT_EQ(header.metadata.collider, "ode");
    EXPECT_EQ(header.metadata.values, metadata.values);
    ASSERT_TRUE(header.view.has_value());
    EXPECT_EQ(header.view->eye, scene.view->eye);
    EXPECT_EQ(header.view->target, scene.view->target);
    EXPECT_EQ(header.view->field_of_view, 33);
    ASSERT_EQ(header.bodies.size(), scene.bodies.size());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        EXPECT_EQ(header.bodies[i].name, scene.bodies[i].name);
        EXPECT_EQ(header.bodies[i].geometry, scene.bodies[i].geometry);
        EXPECT_EQ(header.bodies[i].motion, scene.bodies[i].motion);
        EXPECT_EQ(header.bodies[i].color, scene.bodies[i].color);
    }
    ASSERT_EQ(header.geometries.size(), scene.geometries.size());
    for (std::size_t i = 0; i < scene.geometries.size(); ++i) {
        const Geometry &a = scene.geometries[i], &b = header.geometries[i];
        EXPECT_EQ(a.kind, b.kind);
        EXPECT_EQ(a.radius, b.radius);
        EXPECT_EQ(a.half_height, b.half_height);
        EXPECT_EQ(a.half_extents, b.half_extents);
        EXPECT_EQ(a.vertices, b.vertices);
        EXPECT_EQ(a.faces, b.faces);
        EXPECT_EQ(a.triangles, b.triangles);
        EXPECT_EQ(a.heights, b.heights);
        EXPECT_EQ(a.rows, b.rows);
        EXPECT_EQ(a.spacing_x, b.spacing_x);
        ASSERT_EQ(a.parts.size(), b.parts.size());
        for (std::size_t k = 0; k < a.parts.size(); ++k) {
            EXPECT_EQ(a.parts[k].geometry.kind, b.parts[k].geometry.kind);
            EXPECT_EQ(a.parts[k].local.position, b.parts[k].local.position);
            EXPECT_TRUE(a.parts[k].local.rotation.isApprox(b.parts[k].local.rotation, 0));
        }
    }
}

TEST_F(RecordingTest, CutAtAnyByteItKeepsTheWholeFrames) {
    const std::vector<std::size_t> sizes = record(falling_scene(2), 4);
    const std::string whole = content_of(path("run.plumb"));
    ASSERT_EQ(whole.size(), sizes.back());
    for (std::size_t length = 0; length <= whole.size(); ++length) {
        write("cut.plumb", whole.substr(0, length));
        if (length < sizes[0]) {
            EXPECT_THROW(read_recording(path("cut.plumb")), OutputError) << length;
            continue;
        }
        const auto after = std::upper_bound(sizes.begin(), sizes.end(), length);
        const auto frames = static_cast<std::size_t>(after - sizes.begin() - 1);
        const Recording recording = read_recording(path("cut.plumb"));
        EXPECT_EQ(recording.frames.size(), frames) << length;
        EXPECT_EQ(recording.dropped_bytes, length - sizes[frames]) << length;
    }
}

TEST_F(RecordingTest, DamageToAnyByteIsNoticed) {
    const std::vector<std::size_t> sizes = record(falling_scene(1), 3);
    const std::string whole = content_of(path("run.plumb"));
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        write("bad.plumb", damaged);
        if (at < sizes[0]) {
            EXPECT_THROW(read_recording(path("bad.plumb")), OutputError) << at;
            continue;
        }
        const auto after = std::upper_bound(sizes.begin(), sizes.end(), at);
        const auto frames = static_cast<std::size_t>(after - sizes.begin() - 1);
        const Recording recording = read_recording(path("bad.plumb"));
        EXPECT_EQ(recording.frames.size(), frames) << at;
        EXPECT_EQ(recording.dropped_bytes, whole.size() - sizes[frames]) << at;
    }
}

TEST_F(RecordingTest, KilledProcessLeavesEveryFrameThatItAppended) {
    const Scene scene = falling_scene(5);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        RecordingWriter writer(path("killed.plumb"), scene, {});
        for (std::uint64_t i = 0; i < 7; ++i) writer.append(falling_frame(scene, i, 0.0));
        raise(SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(read_recording(path("killed.plumb")).frames.size(), 7u);
}

TEST_F(RecordingTest, FullDiskIsReportedWithPathAndReason) {
    try {
        RecordingWriter writer("/dev/full", falling_scene(1), {});
        FAIL() << "nothing was thrown";
    } catch (const OutputError& error) {
        EXPECT_EQ(error.path(), "/dev/full");
        EXPECT_STREQ(error.what(), "/dev/full: cannot be written: No space left on device");
    }
}

TEST_F(RecordingTest, StateThatIsNotFiniteDoesNotHurtTheOthers) {
    const Scene scene = falling_scene(3);
    Frame frame = falling_frame(scene, 1, 0.5);
    frame.bodies[2].placement.position.setConstant(std::numeric_limits<double>::infinity());
    frame.bodies[2].placement.rotation.coeffs().setConstant(std::nan(""));
    RecordingWriter writer(path("run.plumb"), scene, {});
    writer.append(frame);
    writer.close();
    const Frame back = read_recording(path("run.plumb")).frames.at(0);
    EXPECT_TRUE(std::isinf(back.bodies[2].placement.position.x()));
    expect_near(back.bodies[3].placement.position, frame.bodies[3].placement.position, 1e-6);
}

TEST_F(RecordingTest, ResidualTakesTwelveBytesAFrameAndMayBeLeftOut) {
    const Scene scene = falling_scene(1);
    RecordingHeader without = recording_header(scene, {});
    EXPECT_TRUE(without.residuals);
    without.residuals = false;
    const auto bytes_of_a_frame = [&](const RecordingHeader& header) {
        RecordingWriter writer(path("run.plumb"), header);
        const auto before = std::filesystem::file_size(path("run.plumb"));
        Frame frame = falling_frame(scene, 0, 0);
        frame.residual = {};
        writer.append(frame);
        return std::filesystem::file_size(path("run.plumb")) - before;
    };
    EXPECT_EQ(bytes_of_a_frame(without), 8 + 48 + 44 * scene.bodies.size());
    EXPECT_EQ(bytes_of_a_frame(recording_header(scene, {})), 8 + 60 + 44 * scene.bodies.size());
    const Recording recording = read_recording(path("run.plumb"));
    EXPECT_TRUE(recording.header.residuals);
    EXPECT_TRUE(std::isnan(recording.frames.at(0).residual.force));
}

TEST_F(RecordingTest, HeaderTellsTheUnitsOfResiduals) {
    record(falling_scene(1), 0);
    EXPECT_NE(content_of(path("run.plumb"))
                  .find(R"("residual":{"error":"m","force":"N","force_of_weight":"1"})"),
              std::string::npos);
}

/// A file by the text of the format: a ball that nothing draws, recorded by some version.
class HandMade {
public:
    HandMade(std::uint32_t version, const std::string& more_of_header) : bytes_("PLUMBREC") {
        put(bytes_, version);
        add(R"({"bodies":[{"color":0,"geometry":4294967295,"motion":2,"name":"ball"}],)"
            R"("collider":"ode","description":"","dt":0.01,"geometries":[],)"
            R"("gravity":[0.0,-9.81,0.0],)"
            R"("metadata":{},"method":"pbd","name":"old","origin":[1.0,0.0,0.0])" +
            more_of_header + "}");
    }

    /// A frame in which the ball is at a height; `residual`: its bytes.
    void add_frame(float height, const std::string& residual) {
        std::string payload;
        put(payload, std::uint64_t{7});
        put(payload, 0.07);
        put(payload, std::uint32_t{3});
        for (const double energy_or_depth : {1.5, 2.5, 0.125}) put(payload, energy_or_depth);
        payload += residual;
        put(payload, std::uint32_t{1});
        for (const float place : {0.f, height, 0.f}) put(payload, place);
        const std::uint64_t upright = 1 << 19;  // a part that is 0, of 20 bits
        put(payload, ((3ull << 20 | upright) << 20 | upright) << 20 | upright);
        for (int i = 0; i < 6; ++i) put(payload, 0.5f);
        add(payload);
    }

    const std::string& bytes() const { return bytes_; }

private:
    void add(const std::string& payload) {
        std::string framed;
        put(framed, static_cast<std::uint32_t>(payload.size()));
        const auto sum = [](uLong before, const std::string& of) {
            return crc32(before, reinterpret_cast<const Bytef*>(of.data()),
                         static_cast<uInt>(of.size()));
        };
        put(framed, static_cast<std::uint32_t>(sum(sum(0, framed), payload)));
        bytes_ += framed + payload;
    }

    std::string bytes_;
};

const std::string kResidualKey = R"(,"residual":{"error":"m","force":"N","force_of_weight":"1"})";

std::string residual_bytes(float of_weight, float force, float error) {
    std::string bytes;
    put(bytes, of_weight), put(bytes, force), put(bytes, error);
    return bytes;
}

TEST_F(RecordingTest, FilesFromBeforeResidualsAreReadWithoutThemAndStayOfTheirVersion) {
    HandMade old(1, "");
    old.add_frame(2.25f, ""), old.add_frame(2.5f, "");
    write("old.plumb", old.bytes());
    const Recording recording = read_recording(path("old.plumb"));
    EXPECT_FALSE(recording.header.residuals);
    EXPECT_EQ(recording.dropped_bytes, 0u);
    ASSERT_EQ(recording.frames.size(), 2u);
    EXPECT_EQ(recording.frames[1].bodies[0].placement.position, Eigen::Vector3d(1, 2.5, 0));
    EXPECT_EQ(recording.frames[1].deepest_penetration, 0.125);
    EXPECT_TRUE(std::isnan(recording.frames[1].residual.force_of_weight));
    EXPECT_TRUE(std::isnan(recording.frames[1].residual.force));
    EXPECT_TRUE(std::isnan(recording.frames[1].residual.error));

    export_recording(path("again.plumb"), recording);
    EXPECT_EQ(content_of(path("again.plumb")), old.bytes());
}

TEST_F(RecordingTest, ResidualsThatAreNotFiniteAreReadAsSuchAndOnesThatAreMissingEndTheFile) {
    const float infinite = std::numeric_limits<float>::infinity();
    HandMade file(4, kResidualKey);
    file.add_frame(2, residual_bytes(0.25f, 3, 0.5f));
    file.add_frame(2, residual_bytes(std::nanf(""), infinite, -infinite));
    const std::size_t sound = file.bytes().size();
    file.add_frame(2, residual_bytes(0.25f, 3, 0.5f).substr(4));
    write("run.plumb", file.bytes());
    const Recording recording = read_recording(path("run.plumb"));
    ASSERT_EQ(recording.frames.size(), 2u);
    EXPECT_EQ(recording.frames[0].residual.force_of_weight, 0.25);
    EXPECT_EQ(recording.frames[0].residual.force, 3);
    EXPECT_EQ(recording.frames[0].residual.error, 0.5);
    EXPECT_TRUE(std::isnan(recording.frames[1].residual.force_of_weight));
    EXPECT_EQ(recording.frames[1].residual.force, std::numeric_limits<double>::infinity());
    EXPECT_EQ(recording.frames[1].residual.error, -std::numeric_limits<double>::infinity());
    EXPECT_EQ(recording.dropped_bytes, file.bytes().size() - sound);

    HandMade without(4, "");  // bytes that the header does not speak of
    without.add_frame(2, residual_bytes(0.25f, 3, 0.5f));
    write("without.plumb", without.bytes());
    EXPECT_EQ(read_recording(path("without.plumb")).frames.size(), 0u);
}

TEST_F(RecordingTest, OtherFilesAndVersionsAreRefused) {
    write("other.plumb", "PNG or whatever else");
    EXPECT_THROW(read_recording(path("other.plumb")), OutputError);
    record(falling_scene(1), 1);
    std::string newer = content_of(path("run.plumb"));
    newer[8] = 5;
    write("newer.plumb", newer);
    try {
        read_recording(path("newer.plumb"));
        FAIL() << "nothing was thrown";
    } catch (const OutputError& error) {
        EXPECT_NE(std::string(error.what()).find("version 5"), std::string::npos);
    }
}

}  // namespace
}  // namespace plumb::test
