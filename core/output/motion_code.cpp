// SPDX-License-Identifier: MIT
#include "output/motion_code.h"

#include "output/deflate.h"
#include "output/zigzag.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

constexpr double kMostSteps = 65535;

std::uint16_t position_integer(const PoseSample& sample, const PositionGrid& grid, int axis) {
    const double place = static_cast<double>(sample.position[static_cast<std::size_t>(axis)]);
    const double step = std::round((place - grid.low[axis]) / grid.quantum);
    return static_cast<std::uint16_t>(std::isfinite(step) ? std::clamp(step, 0.0, kMostSteps)
                                                          : 0.0);
}

/// Value of a channel: 0…2 position, 3…5 rotation.
std::uint16_t channel_value(const PoseSample& sample, const PositionGrid& grid, int channel) {
    if (channel < 3) return position_integer(sample, grid, channel);
    return sample.small[static_cast<std::size_t>(channel - 3)];
}

/// Adds the differences of one body's channel to the planes of low and high bytes.
void put_channel(std::string& low, std::string& high, const std::vector<PoseSample>& motion,
                 const PositionGrid& grid, int channel) {
    std::uint16_t previous = 0, before = 0;
    for (const PoseSample& sample : motion) {
        const std::uint16_t value = channel_value(sample, grid, channel);
        const std::uint16_t code =
            zigzag(static_cast<std::uint16_t>(value - 2 * previous + before));
        low.push_back(static_cast<char>(code & 0xff));
        high.push_back(static_cast<char>(code >> 8));
        before = previous;
        previous = value;
    }
}

void put_largest(std::string& bytes, const std::vector<PoseSample>& motion) {
    unsigned previous = 0;
    for (const PoseSample& sample : motion) {
        bytes.push_back(static_cast<char>((sample.largest - previous) & 3u));
        previous = sample.largest;
    }
}

}  // namespace

PoseSample pose_sample(const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation) {
    const RotationCode code = encode_rotation(rotation, kReplayRotationBits);
    PoseSample sample{};
    for (std::size_t i = 0; i < 3; ++i) {
        sample.position[i] = static_cast<float>(position[static_cast<Eigen::Index>(i)]);
        sample.small[i] = static_cast<std::uint16_t>(code.small[i]);
    }
    sample.largest = static_cast<std::uint16_t>(code.largest);
    return sample;
}

PositionGrid position_grid(const std::vector<PoseSample>& motion, double finest) {
    Eigen::AlignedBox3d box;
    for (const PoseSample& sample : motion) {
        const Eigen::Vector3d place =
            Eigen::Map<const Eigen::Vector3f>(sample.position.data()).cast<double>();
        if (place.allFinite()) box.extend(place);
    }
    PositionGrid grid;
    if (box.isEmpty()) return grid;
    grid.low = box.min();
    grid.quantum = std::max({box.sizes().maxCoeff() / kMostSteps, finest, 1e-12});
    return grid;
}

std::string encode_motion(const std::vector<std::vector<PoseSample>>& motions,
                          const std::vector<PositionGrid>& grids) {
    std::string bytes;
    for (int channel = 0; channel < 6; ++channel) {
        std::string low, high;
        for (std::size_t i = 0; i < motions.size(); ++i) {
            put_channel(low, high, motions[i], grids[i], channel);
        }
        bytes += low + high;
    }
    for (const std::vector<PoseSample>& motion : motions) put_largest(bytes, motion);
    return deflated(bytes);
}

}  // namespace plumb
