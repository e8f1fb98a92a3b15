// SPDX-License-Identifier: MIT
/// Recordings: what is needed to draw a run, and its frames, in memory or as a `.plumb` file.
///
/// A `.plumb` file only ever grows, and each frame has left the program before the next step
/// begins: after a crash, a kill or a full disk, everything up to the last whole frame opens. All
/// numbers are little-endian:
///
///     "PLUMBREC"  u32 version  u32 length of header  u32 checksum of length and header
///         header (JSON)
///     then, for each frame: u32 length of payload  u32 checksum of length and payload  payload
///     payload: u64 step  f64 time  u32 contacts  f64 kinetic, potential, penetration
///         residual  u32 bodies  bodies  deformables  torn
///     residual, 12 bytes, where the header has that key, which names the units: f32 force as a
///         share of the worst island's weight  f32 worst force [N]  f32 worst error [m], of the
///         step that ended at the frame (effects/residual.h); NaN where there was none
///     body, 44 bytes: 3 × f32 position less origin  u64 rotation  3 × f32 velocity
///         3 × f32 angular velocity
///     rotation: 2 bits index of the largest component, then three times 20 bits (rotation_code.h)
///     deformable, 16 bytes and 6 for each of its points: places in the box about them, to 1e-4 of
///         its size or better (particle_code.h)
///     torn, where a deformable of the header tears: u32 count, and so often u32 deformable
///         u32 element, of those that have torn since the start, sorted
///
/// The checksum is the CRC-32 of zlib. The origin, in the header, is a point near the bodies and
/// deformables at the start. Files with residuals are of version 4, as all are that a run writes.
/// What was made of an older one has none: with deformables or links it is of version 2, with some
/// that tear of version 3, else of version 1.
#pragma once

#include "measure/frame.h"
#include "output/file.h"
#include "output/recorded_deformable.h"
#include "scene/scene.h"

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

inline constexpr int kRecordedRotationBits = 20;

/// What a run adds to what its scene says.
struct Metadata {
    std::string collider;                       ///< name of the collider that the run used
    std::map<std::string, std::string> values;  ///< whatever else the caller wants to keep
};

/// What a body needs to be drawn.
struct RecordedBody {
    std::string name;
    std::uint32_t geometry =
        kNoIndex;  ///< index into RecordingHeader::geometries, or kNoIndex: nothing to draw
    Motion motion = Motion::dynamic;
    std::uint32_t color = 0;  ///< 0xRRGGBB, 0 = chosen by the viewer
};

/// What is needed to draw and to tell about a run, besides its frames.
struct RecordingHeader {
    std::string name, description;
    std::string method;
    double dt = 0;  ///< step of the simulation [s]; frames may be further apart
    Eigen::Vector3d gravity{0, -9.81, 0};  ///< [m/s²]; up is against it
    std::vector<Geometry> geometries;
    std::vector<RecordedBody> bodies;
    std::vector<RecordedDeformable> deformables;
    std::vector<RecordedLink> links;
    bool residuals = false;  ///< frames tell how far their steps were from being solved
    std::optional<View> view;
    Eigen::Vector3d origin =
        Eigen::Vector3d::Zero();  ///< recorded positions are relative to it [m]
    Metadata metadata;
};

struct Recording {
    RecordingHeader header;
    std::vector<Frame> frames;
    std::uint64_t dropped_bytes =
        0;  ///< at the end of the file, not part of a whole and sound frame
};

RecordingHeader recording_header(const Scene& scene, const Metadata& metadata);

/// Throws OutputError where a frame is not of the bodies and particles of the header: some came or
/// went since the start, which no output has a form for.
void expect_bodies_of(const RecordingHeader& header, const Frame& frame, const std::string& path);

/// Writes a `.plumb` file, frame by frame. Throws OutputError when the file cannot be written; the
/// frames before stay readable.
class RecordingWriter {
public:
    RecordingWriter(std::string path, RecordingHeader header);
    RecordingWriter(std::string path, const Scene& scene, const Metadata& metadata)
        : RecordingWriter(std::move(path), recording_header(scene, metadata)) {}

    void append(const Frame& frame);
    void close() { file_.close(); }

private:
    RecordingHeader header_;
    AppendFile file_;
};

/// Reads a `.plumb` file up to its last whole frame. Throws OutputError when even the header is not
/// whole.
Recording read_recording(const std::string& path);

}  // namespace plumb
