// SPDX-License-Identifier: MIT
#include "output/csv.h"

#include <charconv>

namespace plumb {
namespace {

constexpr std::string_view kColumns = "step,time,body,name,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n";

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

}  // namespace

CsvExporter::CsvExporter(const std::string& path, const RecordingHeader& header)
    : header_(header), file_(path) {
    for (const RecordedBody& body : header.bodies) names_.push_back(quoted(body.name));
    file_.append(kColumns);
}

void CsvExporter::append(const Frame& frame) {
    expect_bodies_of(header_, frame, file_.path());
    std::string rows;
    for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
        const BodyState& body = frame.bodies[i];
        put_number(rows, frame.step);
        rows += ',';
        put_number(rows, frame.time);
        rows += ',';
        put_number(rows, i);
        rows += ',';
        if (i < names_.size()) rows += names_[i];
        put_vector(rows, body.placement.position);
        put_vector(rows, body.placement.rotation.coeffs());
        put_vector(rows, body.velocity);
        put_vector(rows, body.angular_velocity);
        rows += '\n';
    }
    file_.append(rows);
}

}  // namespace plumb
