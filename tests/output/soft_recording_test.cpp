// SPDX-License-Identifier: MIT
#include "output/recording.h"

#include "geometry/outer_faces.h"
#include "output/error.h"
#include "output/exporters.h"
#include "soft.h"
#include "temporary_folder.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace plumb::test {
namespace {

class SoftRecordingTest : public TemporaryFolder {
protected:
    Recording there_and_back(const Scene& scene, const std::vector<Frame>& frames) {
        RecordingWriter writer(path("run.plumb"), scene, {});
        for (const Frame& frame : frames) writer.append(frame);
        writer.close();
        return read_recording(path("run.plumb"));
    }
};

/// Longest side of the box about some particles [m].
double side_of(const Frame& frame, const RecordedDeformable& deformable) {
    Eigen::AlignedBox3d box;
    for (std::uint32_t i = 0; i < deformable.count; ++i)
        box.extend(frame.particles[deformable.first + i]);
    return box.sizes().maxCoeff();
}

TEST_F(SoftRecordingTest, PlacesComeBackToATenThousandthOfTheSize) {
    Scene scene = soft_scene(3);
    for (DeformableSpec& spec : scene.deformables) move_to(spec, {1000, 0, 0});
    scene.bodies[0].placement.position.x() += 1000;
    std::vector<Frame> frames;
    for (std::uint64_t i = 0; i < 5; ++i)
        frames.push_back(soft_frame(scene, i, 0.1 * static_cast<double>(i)));
    const Recording recording = there_and_back(scene, frames);
    ASSERT_EQ(recording.frames.size(), frames.size());
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const Frame &wanted = frames[f], &got = recording.frames[f];
        ASSERT_EQ(got.particles.size(), wanted.particles.size());
        for (const RecordedDeformable& d : recording.header.deformables) {
            // a float loses some of its distance from the origin, which is in the middle
            const double bound = side_of(wanted, d) / 131070 + 1e-6;
            for (std::uint32_t i = d.first; i < d.first + d.count; ++i) {
                const Eigen::Vector3d error = got.particles[i] - wanted.particles[i];
                EXPECT_LE(error.cwiseAbs().maxCoeff(), bound);
                EXPECT_LE(error.norm(), 1e-4 * d.size);
            }
        }
    }
}

TEST_F(SoftRecordingTest, APointTakesSixBytes) {
    const Scene scene = soft_scene(4);
    RecordingWriter writer(path("run.plumb"), scene, {});
    const auto before = std::filesystem::file_size(path("run.plumb"));
    const Frame frame = soft_frame(scene, 0, 0.4);
    writer.append(frame);
    EXPECT_EQ(std::filesystem::file_size(path("run.plumb")) - before,
              8 + 60 + 44 * scene.bodies.size() + 16 * scene.deformables.size() +
                  6 * frame.particles.size());
}

TEST_F(SoftRecordingTest, WhatFliesApartOrIsNotFiniteLeavesTheOthersExact) {
    const Scene scene = soft_scene(2);
    Frame far = soft_frame(scene, 0, 0.4), broken = far;
    far.particles[3].x() += 1e5;
    broken.particles[3].y() = std::nan("");
    broken.particles[4].z() = std::numeric_limits<double>::infinity();
    const Recording recording = there_and_back(scene, {far, broken});
    ASSERT_EQ(recording.frames.size(), 2u);
    const auto& after = recording.frames[1].particles;
    EXPECT_TRUE(std::isnan(after[3].y()));
    EXPECT_TRUE(std::isinf(after[4].z()));
    EXPECT_NEAR(recording.frames[0].particles[3].x(), far.particles[3].x(), 0.01);
    for (std::size_t i = 5; i < far.particles.size(); ++i) {
        EXPECT_LE((recording.frames[0].particles[i] - far.particles[i]).norm(), 1e-4 * 0.6);
        EXPECT_LE((after[i] - broken.particles[i]).norm(), 1e-4 * 0.6);
    }
}

TEST_F(SoftRecordingTest, WhatIsTornComesBack) {
    Scene scene = soft_scene(2);
    Frame frame = soft_frame(scene, 0, 0.4);
    frame.torn = {{1, 3}, {2, 0}, {2, 7}};
    EXPECT_TRUE(there_and_back(scene, {frame}).frames[0].torn.empty()) << "none of them tears";
    scene.deformables[1].tearing_strain = scene.deformables[2].tearing_strain = 0.5;
    const Frame whole = soft_frame(scene, 1, 0.4);
    const Recording recording = there_and_back(scene, {whole, frame});
    ASSERT_EQ(recording.frames.size(), 2u);
    EXPECT_TRUE(recording.frames[0].torn.empty());
    EXPECT_EQ(recording.frames[1].torn, frame.torn);
    EXPECT_EQ(recording.dropped_bytes, 0u);
    frame.torn.push_back({3, 100});  // an element that there is not
    EXPECT_EQ(there_and_back(scene, {whole, frame}).frames.size(), 1u);
}

TEST_F(SoftRecordingTest, HeaderComesBackWhole) {
    Scene scene = soft_scene(2);
    scene.deformables[0].color = 0x123456;
    scene.deformables[2].tearing_strain = scene.deformables[3].tearing_strain = 0.25;
    const RecordingHeader wanted = recording_header(scene, {});
    const RecordingHeader got = there_and_back(scene, {}).header;
    ASSERT_EQ(got.deformables.size(), 4u);
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const DeformableSpec& spec = scene.deformables[i];
        const RecordedDeformable &a = wanted.deformables[i], &b = got.deformables[i];
        EXPECT_EQ(b.name, spec.name);
        EXPECT_EQ(b.kind, spec.kind);
        EXPECT_EQ(b.first, first);
        EXPECT_EQ(b.count, spec.points.size());
        EXPECT_EQ(b.segments, spec.segments);
        EXPECT_EQ(b.triangles, a.triangles);
        EXPECT_EQ(b.thickness, spec.thickness);
        EXPECT_EQ(b.radius, spec.radius);
        EXPECT_EQ(b.color, spec.color);
        first += b.count;
    }
    EXPECT_DOUBLE_EQ(got.deformables[0].size, 2);
    EXPECT_DOUBLE_EQ(got.deformables[1].size, 1);
    EXPECT_EQ(got.deformables[0].triangles, scene.deformables[0].triangles);

    EXPECT_FALSE(got.deformables[0].tears);
    EXPECT_TRUE(got.deformables[3].tears);
    EXPECT_TRUE(got.deformables[2].tears);
    EXPECT_EQ(got.deformables[2].tetrahedra, scene.deformables[2].tetrahedra);

    ASSERT_EQ(got.links.size(), 2u);
    const Frame frame = soft_frame(scene, 0, 0);  // where all is as at the start
    for (const RecordedLink& link : got.links) {
        EXPECT_LE((place_of(link.a, frame) - scene.links[0].a.position).norm(), 1e-12);
        EXPECT_LE((place_of(link.b, frame) - scene.deformables[1].points[2]).norm(), 1e-12);
    }
    EXPECT_EQ(got.links[0].a.body, 0u);
    EXPECT_EQ(got.links[1].a.body, kNoIndex);
}

TEST_F(SoftRecordingTest, CutAtAnyByteItKeepsTheWholeFrames) {
    const Scene scene = soft_scene(1);
    RecordingWriter writer(path("run.plumb"), scene, {});
    std::vector<std::size_t> sizes{std::filesystem::file_size(path("run.plumb"))};
    for (std::uint64_t i = 0; i < 3; ++i) {
        writer.append(soft_frame(scene, i, 0.2));
        sizes.push_back(std::filesystem::file_size(path("run.plumb")));
    }
    const std::string whole = read_file(path("run.plumb"));
    ASSERT_EQ(whole.size(), sizes.back());
    for (std::size_t length = sizes[0]; length <= whole.size(); ++length) {
        write("cut.plumb", whole.substr(0, length));
        const auto after = std::upper_bound(sizes.begin(), sizes.end(), length);
        const Recording recording = read_recording(path("cut.plumb"));
        EXPECT_EQ(recording.frames.size(), static_cast<std::size_t>(after - sizes.begin() - 1));
    }
}

/// What has no residuals is written as it was before there were any, and so is what has no
/// deformables besides, and all are read.
TEST_F(SoftRecordingTest, VersionIsTheLeastThatWillDo) {
    const auto version = [this](const Scene& scene, bool residuals) {
        RecordingHeader header = recording_header(scene, {});
        header.residuals = residuals;
        RecordingWriter(path("run.plumb"), header).append(soft_frame(scene, 0, 0));
        const Recording recording = read_recording(path("run.plumb"));
        EXPECT_EQ(recording.frames.size(), 1u);
        EXPECT_EQ(recording.header.deformables.size(), scene.deformables.size());
        EXPECT_EQ(recording.header.residuals, residuals);
        return static_cast<int>(read_file(path("run.plumb"))[8]);
    };
    Scene scene = soft_scene(1);
    EXPECT_EQ(version(scene, false), 2);
    EXPECT_EQ(version(scene, true), 4);
    scene.deformables[1].tearing_strain = 0.5;
    EXPECT_EQ(version(scene, false), 3);
    EXPECT_EQ(version(scene, true), 4);
    scene.deformables.clear(), scene.links.clear();
    EXPECT_EQ(version(scene, false), 1);
    EXPECT_EQ(read_file(path("run.plumb")).find("deformables"), std::string::npos);
    EXPECT_EQ(version(scene, true), 4);
}

/// The surface that is found is closed, faces outwards, and holds the volume.
TEST(OuterFaces, OfACubeAreItsSixSides) {
    for (const std::uint32_t n : {1u, 3u}) {
        const DeformableSpec cube = jelly(n, 0.6);
        const auto faces = outer_faces(cube.tetrahedra);
        EXPECT_EQ(faces.size(), 12u * n * n);
        double volume = 0, area = 0;
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const auto& [a, b, c] : faces) {
            const Eigen::Vector3d &p = cube.points[a], &q = cube.points[b], &r = cube.points[c];
            const Eigen::Vector3d normal = 0.5 * (q - p).cross(r - p);
            volume += normal.dot(p) / 3;
            area += normal.norm();
            sum += normal;
        }
        EXPECT_NEAR(volume, 0.6 * 0.6 * 0.6, 1e-12);
        EXPECT_NEAR(area, 6 * 0.6 * 0.6, 1e-12);
        EXPECT_LT(sum.norm(), 1e-12);
    }
}

class SoftEnding : public SoftRecordingTest, public testing::WithParamInterface<const char*> {};

TEST_P(SoftEnding, FramesOfOtherParticlesAreRefused) {
    const Scene scene = soft_scene(1);
    const auto exporter = make_exporter(path("run") + GetParam(), scene, {});
    Frame frame = soft_frame(scene, 0, 0);
    exporter->append(frame);
    frame.particles.pop_back();
    EXPECT_THROW(exporter->append(frame), OutputError);
    frame.particles.clear();
    EXPECT_THROW(exporter->append(frame), OutputError);
}

TEST_P(SoftEnding, IsMadeOfARecordingToo) {
    const Scene scene = soft_scene(2);
    const Recording recording = there_and_back(scene, {soft_frame(scene, 0, 0.1)});
    export_recording(path("again") + GetParam(), recording);
    EXPECT_GT(std::filesystem::file_size(path("again") + GetParam()), 1000u);
}

INSTANTIATE_TEST_SUITE_P(Endings, SoftEnding, testing::Values(".html", ".png", ".csv", ".plumb"));

}  // namespace
}  // namespace plumb::test
