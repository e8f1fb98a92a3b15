// SPDX-License-Identifier: MIT
#include "output/particle_code.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {
namespace {

constexpr double kGridSteps = 65535;
constexpr double kMostGrowth = 7;  // of the box: √3 · 7 / 131070 is below 1e-4
constexpr std::size_t kIntegerBytes = 6, kFloatBytes = 12;

/// Rounded up, so that the grid reaches over the whole box.
float quantum_of(double side) {
    return std::nextafter(static_cast<float>(side / kGridSteps),
                          std::numeric_limits<float>::infinity());
}

void put_floats(std::string& bytes, const Eigen::Vector3d& v) {
    for (Eigen::Index i = 0; i < 3; ++i) put(bytes, static_cast<float>(v[i]));
}

Eigen::Vector3d take_floats(ByteReader& reader) {
    Eigen::Vector3d v;
    for (Eigen::Index i = 0; i < 3; ++i) v[i] = static_cast<double>(reader.take<float>());
    return v;
}

}  // namespace

void put_places(std::string& bytes, std::span<const Eigen::Vector3d> places,
                const Eigen::Vector3d& origin, double size) {
    Eigen::AlignedBox3d box;
    bool finite = true;
    for (const Eigen::Vector3d& place : places) {
        finite = finite && place.allFinite();
        box.extend(place - origin);
    }
    const double side = finite && !box.isEmpty() ? box.sizes().maxCoeff() : 0;
    if (!(side > 0 && side <= kMostGrowth * size)) {
        put(bytes, 0.0f);
        for (const Eigen::Vector3d& place : places) put_floats(bytes, place - origin);
        return;
    }
    const float quantum = quantum_of(side);
    put(bytes, quantum);
    put_floats(bytes, box.min());
    const Eigen::Vector3d low = origin + box.min().cast<float>().cast<double>();
    for (const Eigen::Vector3d& place : places) {
        for (Eigen::Index i = 0; i < 3; ++i) {
            const double step = std::round((place[i] - low[i]) / static_cast<double>(quantum));
            put(bytes, static_cast<std::uint16_t>(std::clamp(step, 0.0, kGridSteps)));
        }
    }
}

bool take_places(ByteReader& reader, std::span<Eigen::Vector3d> places,
                 const Eigen::Vector3d& origin) {
    if (reader.left() < sizeof(float)) return false;
    const auto quantum = static_cast<double>(reader.take<float>());
    if (!(quantum > 0)) {
        if (reader.left() < kFloatBytes * places.size()) return false;
        for (Eigen::Vector3d& place : places) place = take_floats(reader) + origin;
        return true;
    }
    if (reader.left() < kFloatBytes + kIntegerBytes * places.size()) return false;
    const Eigen::Vector3d low = origin + take_floats(reader);
    for (Eigen::Vector3d& place : places)
        for (Eigen::Index i = 0; i < 3; ++i)
            place[i] = low[i] + quantum * reader.take<std::uint16_t>();
    return true;
}

}  // namespace plumb
