// SPDX-License-Identifier: MIT
#include "output/recording.h"

#include "math/bytes.h"
#include "output/error.h"
#include "output/header_json.h"
#include "output/particle_code.h"
#include "output/rotation_code.h"

#include <zlib.h>

#include <algorithm>
#include <exception>
#include <span>

namespace plumb {
namespace {

constexpr std::string_view kMagic = "PLUMBREC";
constexpr std::uint32_t kVersion = 4, kVersionWithoutResiduals = 3, kVersionWithoutTears = 2,
                        kVersionWithoutDeformables = 1;
constexpr std::size_t kFrameBytes =
    48;  // of a payload without its residual, bodies and deformables
constexpr std::size_t kResidualBytes = 12;
constexpr std::size_t kBodyBytes = 44;
constexpr std::size_t kParticleBytes = 6;  // at the least

std::uint32_t checksum(std::string_view bytes, std::uint32_t before = 0) {
    return static_cast<std::uint32_t>(
        crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

/// A length and its bytes under one checksum, so that a damaged length is noticed too.
std::string framed(std::string_view payload) {
    std::string bytes;
    bytes.reserve(payload.size() + 8);
    put(bytes, static_cast<std::uint32_t>(payload.size()));
    put(bytes, checksum(payload, checksum(bytes)));
    bytes.append(payload);
    return bytes;
}

/// The next framed payload, or nothing where the bytes end before it does or the checksum differs.
std::optional<std::string_view> next_framed(ByteReader& reader) {
    if (reader.left() < 8) return std::nullopt;
    const auto length = reader.take<std::uint32_t>();
    const auto expected = reader.take<std::uint32_t>();
    if (reader.left() < length) return std::nullopt;
    const std::string_view payload = reader.take_bytes(length);
    std::string length_bytes;
    put(length_bytes, length);
    if (checksum(payload, checksum(length_bytes)) != expected) return std::nullopt;
    return payload;
}

void put_vector(std::string& bytes, const Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i) put(bytes, static_cast<float>(v[i]));
}

Eigen::Vector3d take_vector(ByteReader& reader) {
    Eigen::Vector3d v;
    for (int i = 0; i < 3; ++i) v[i] = static_cast<double>(reader.take<float>());
    return v;
}

std::uint64_t packed(const RotationCode& code) {
    std::uint64_t bits = code.largest;
    for (const std::uint32_t part : code.small) bits = (bits << kRecordedRotationBits) | part;
    return bits;
}

RotationCode unpacked(std::uint64_t bits) {
    RotationCode code;
    for (std::size_t i = 3; i-- > 0; bits >>= kRecordedRotationBits) {
        code.small[i] = static_cast<std::uint32_t>(bits & ((1u << kRecordedRotationBits) - 1));
    }
    code.largest = static_cast<std::uint32_t>(bits & 3u);
    return code;
}

bool tears(const RecordingHeader& header) {
    return std::any_of(header.deformables.begin(), header.deformables.end(),
                       [](const RecordedDeformable& d) { return d.tears; });
}

void put_torn(std::string& bytes, const std::vector<std::array<std::uint32_t, 2>>& torn) {
    put(bytes, static_cast<std::uint32_t>(torn.size()));
    for (const auto& [deformable, element] : torn) put(bytes, deformable), put(bytes, element);
}

/// False where they are not elements of the header's deformables.
bool take_torn(ByteReader& reader, const RecordingHeader& header, Frame& frame) {
    if (reader.left() < 4) return false;
    const auto count = reader.take<std::uint32_t>();
    if (reader.left() / 8 < count) return false;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto deformable = reader.take<std::uint32_t>(),
                   element = reader.take<std::uint32_t>();
        if (deformable >= header.deformables.size() ||
            element >= element_count(header.deformables[deformable]))
            return false;
        frame.torn.push_back({deformable, element});
    }
    return std::is_sorted(frame.torn.begin(), frame.torn.end());
}

/// The lowest that has all that the header calls for.
std::uint32_t version_of(const RecordingHeader& header) {
    if (header.residuals) return kVersion;
    if (tears(header)) return kVersionWithoutResiduals;
    const bool plain = header.deformables.empty() && header.links.empty();
    return plain ? kVersionWithoutDeformables : kVersionWithoutTears;
}

void put_residual(std::string& bytes, const FrameResidual& residual) {
    put_vector(bytes, {residual.force_of_weight, residual.force, residual.error});
}

FrameResidual take_residual(ByteReader& reader) {
    const Eigen::Vector3d numbers = take_vector(reader);
    FrameResidual residual;
    residual.force_of_weight = numbers[0], residual.force = numbers[1], residual.error = numbers[2];
    return residual;
}

std::string frame_payload(const Frame& frame, const RecordingHeader& header) {
    std::string bytes;
    bytes.reserve(kFrameBytes + kResidualBytes + kBodyBytes * frame.bodies.size() +
                  8 * frame.particles.size());
    put(bytes, frame.step);
    put(bytes, frame.time);
    put(bytes, frame.contacts);
    put(bytes, frame.kinetic_energy);
    put(bytes, frame.potential_energy);
    put(bytes, frame.deepest_penetration);
    if (header.residuals) put_residual(bytes, frame.residual);
    put(bytes, static_cast<std::uint32_t>(frame.bodies.size()));
    for (const BodyState& body : frame.bodies) {
        put_vector(bytes, body.placement.position - header.origin);
        put(bytes, packed(encode_rotation(body.placement.rotation, kRecordedRotationBits)));
        put_vector(bytes, body.velocity);
        put_vector(bytes, body.angular_velocity);
    }
    const std::span<const Eigen::Vector3d> places(frame.particles);
    for (const RecordedDeformable& d : header.deformables)
        put_places(bytes, places.subspan(d.first, d.count), header.origin, d.size);
    if (tears(header)) put_torn(bytes, frame.torn);
    return bytes;
}

/// Nothing where the payload does not hold as many bodies and particles as the header, although its
/// checksum is right.
std::optional<Frame> frame_from_payload(std::string_view payload, const RecordingHeader& header) {
    const std::size_t count = header.bodies.size();
    const std::size_t particles = particle_count(header.deformables);
    const std::size_t least = kFrameBytes + (header.residuals ? kResidualBytes : 0) +
                              kBodyBytes * count + kParticleBytes * particles;
    if (payload.size() < least) return std::nullopt;
    ByteReader reader(payload);
    Frame frame;
    frame.step = reader.take<std::uint64_t>();
    frame.time = reader.take<double>();
    frame.contacts = reader.take<std::uint32_t>();
    frame.kinetic_energy = reader.take<double>();
    frame.potential_energy = reader.take<double>();
    frame.deepest_penetration = reader.take<double>();
    if (header.residuals) frame.residual = take_residual(reader);
    if (reader.take<std::uint32_t>() != count) return std::nullopt;
    frame.bodies.resize(count);
    for (BodyState& body : frame.bodies) {
        body.placement.position = take_vector(reader) + header.origin;
        body.placement.rotation =
            decode_rotation(unpacked(reader.take<std::uint64_t>()), kRecordedRotationBits);
        body.velocity = take_vector(reader);
        body.angular_velocity = take_vector(reader);
    }
    frame.particles.resize(particles);
    const std::span<Eigen::Vector3d> places(frame.particles);
    for (const RecordedDeformable& d : header.deformables)
        if (!take_places(reader, places.subspan(d.first, d.count), header.origin))
            return std::nullopt;
    if (tears(header) && !take_torn(reader, header, frame)) return std::nullopt;
    if (reader.left() > 0) return std::nullopt;
    return frame;
}

/// Middle of the bodies and deformables at the start, so that the floats near it are fine.
Eigen::Vector3d middle(const Scene& scene) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0;
    const auto add = [&](const Eigen::Vector3d& place) {
        if (!place.allFinite()) return;
        sum += place;
        ++count;
    };
    for (const BodySpec& body : scene.bodies)
        if (body.motion != Motion::fixed) add(body.placement.position);
    for (const DeformableSpec& deformable : scene.deformables)
        if (!deformable.points.empty()) add(deformable.points[deformable.points.size() / 2]);
    return count > 0 ? Eigen::Vector3d(sum / count) : sum;
}

RecordingHeader take_header(ByteReader& reader, const std::string& path) {
    if (reader.left() < kMagic.size() || reader.take_bytes(kMagic.size()) != kMagic) {
        throw UnreadableFile(path, "is not a recording of Plumb");
    }
    if (reader.left() < 4) throw UnreadableFile(path, "ends within its header");
    if (const auto version = reader.take<std::uint32_t>();
        version < kVersionWithoutDeformables || version > kVersion) {
        throw UnreadableFile(path, "has version " + std::to_string(version) +
                                       ", and only versions up to " + std::to_string(kVersion) +
                                       " can be read");
    }
    const std::optional<std::string_view> text = next_framed(reader);
    if (!text) throw UnreadableFile(path, "has a header that is cut off or damaged");
    try {
        return header_from_json(*text);
    } catch (const std::exception& error) {
        throw UnreadableFile(path,
                             std::string("has a header that cannot be read: ") + error.what());
    }
}

}  // namespace

RecordingHeader recording_header(const Scene& scene, const Metadata& metadata) {
    RecordingHeader header;
    header.name = scene.name;
    header.description = scene.description;
    header.method = scene.settings.method;
    header.dt = scene.settings.dt;
    header.gravity = scene.settings.gravity;
    header.geometries = scene.geometries;
    for (const BodySpec& body : scene.bodies) {
        header.bodies.push_back({body.name, body.geometry, body.motion, body.color});
    }
    header.deformables = recorded_deformables(scene);
    header.links = recorded_links(scene);
    header.residuals = true;
    header.view = scene.view;
    header.origin = middle(scene);
    header.metadata = metadata;
    return header;
}

void expect_bodies_of(const RecordingHeader& header, const Frame& frame, const std::string& path) {
    bool same = frame.bodies.size() == header.bodies.size();
    for (std::size_t i = 0; i < frame.ids.size(); ++i) same = same && frame.ids[i] == i;
    if (!same)
        throw OutputError(path,
                          "takes the bodies of one scene, and since its start some were added or "
                          "removed");
    if (frame.particles.size() != particle_count(header.deformables))
        throw OutputError(path,
                          "takes the particles of one scene, and a frame has others than its "
                          "deformables");
}

RecordingWriter::RecordingWriter(std::string path, RecordingHeader header)
    : header_(std::move(header)), file_(std::move(path)) {
    std::string bytes(kMagic);
    put(bytes, version_of(header_));
    file_.append(bytes + framed(header_to_json(header_)));
}

void RecordingWriter::append(const Frame& frame) {
    expect_bodies_of(header_, frame, file_.path());
    file_.append(framed(frame_payload(frame, header_)));
}

Recording read_recording(const std::string& path) {
    const std::string content = read_file(path);
    ByteReader reader(content);
    Recording recording;
    recording.header = take_header(reader, path);

    std::size_t sound = reader.position();
    while (const std::optional<std::string_view> payload = next_framed(reader)) {
        std::optional<Frame> frame = frame_from_payload(*payload, recording.header);
        if (!frame) break;
        recording.frames.push_back(std::move(*frame));
        sound = reader.position();
    }
    recording.dropped_bytes = content.size() - sound;
    return recording;
}

}  // namespace plumb
