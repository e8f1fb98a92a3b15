// SPDX-License-Identifier: MIT
#include "output/csv.h"

#include <charconv>

namespace plumb {
namespace {

constexpr std::string_view kColumns = "step,time,body,name,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz";
constexpr std::string_view kPointColumns = ",deformable,point";
constexpr std::string_view kOfBodiesAlone = ",,,,,,,,,,";  // from qx to wz

/// A field as RFC 4180 wants it.
std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"') result += '"';
        result += c;
    }
    return result + '"';
}

template <class T>
void put_number(std::string& row, T value) {
    char buffer[32];
    const std::to_chars_result end = std::to_chars(buffer, buffer + sizeof buffer, value);
    row.append(buffer, end.ptr);
}

template <class Vector>
void put_vector(std::string& row, const Vector& v) {
    for (Eigen::Index i = 0; i < v.size(); ++i) {
        row += ',';
        put_number(row, v[i]);
    }
}

void put_moment(std::string& row, const Frame& frame) {
    put_number(row, frame.step);
    row += ',';
    put_number(row, frame.time);
    row += ',';
}

}  // namespace

CsvExporter::CsvExporter(const std::string& path, const RecordingHeader& header)
    : header_(header), file_(path) {
    for (const RecordedBody& body : header.bodies) names_.push_back(quoted(body.name));
    for (const RecordedDeformable& deformable : header.deformables)
        deformable_names_.push_back(quoted(deformable.name));
    std::string columns(kColumns);
    if (!header.deformables.empty()) columns += kPointColumns;
    file_.append(columns + '\n');
}

void CsvExporter::append(const Frame& frame) {
    expect_bodies_of(header_, frame, file_.path());
    std::string rows;
    put_bodies(rows, frame);
    put_points(rows, frame);
    file_.append(rows);
}

void CsvExporter::put_bodies(std::string& rows, const Frame& frame) const {
    const std::string_view no_point = header_.deformables.empty() ? "" : ",,";
    for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
        const BodyState& body = frame.bodies[i];
        put_moment(rows, frame);
        put_number(rows, i);
        rows += ',';
        if (i < names_.size()) rows += names_[i];
        put_vector(rows, body.placement.position);
        put_vector(rows, body.placement.rotation.coeffs());
        put_vector(rows, body.velocity);
        put_vector(rows, body.angular_velocity);
        rows += no_point;
        rows += '\n';
    }
}

void CsvExporter::put_points(std::string& rows, const Frame& frame) const {
    for (std::size_t i = 0; i < header_.deformables.size(); ++i) {
        const RecordedDeformable& deformable = header_.deformables[i];
        for (std::uint32_t point = 0; point < deformable.count; ++point) {
            put_moment(rows, frame);
            rows += ',';
            rows += deformable_names_[i];
            put_vector(rows, frame.particles[deformable.first + point]);
            rows += kOfBodiesAlone;
            rows += ',';
            put_number(rows, i);
            rows += ',';
            put_number(rows, point);
            rows += '\n';
        }
    }
}

}  // namespace plumb
