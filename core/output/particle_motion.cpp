// SPDX-License-Identifier: MIT
#include "output/particle_motion.h"

#include "output/deflate.h"
#include "output/zigzag.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

constexpr double kMost = 65535;
constexpr double kStepsAnEdge = 400;  // an edge's ends half a quantum off turn it by 1/400
constexpr double kStepsASize = 4000;  // where there are no edges

Eigen::AlignedBox3d box_of(const ParticleMotion& motion, std::size_t frame) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = frame * motion.points; i < (frame + 1) * motion.points; ++i)
        if (motion.places[i].allFinite()) box.extend(motion.places[i].cast<double>());
    return box;
}

/// Mean length of the edges at the start [m], or 0.
double mean_edge(const RecordedDeformable& deformable, const ParticleMotion& motion) {
    double sum = 0, count = 0;
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
        const auto length = static_cast<double>((motion.places[a] - motion.places[b]).norm());
        if (!std::isfinite(length)) return;
        sum += length;
        ++count;
    };
    for (const auto& [a, b] : deformable.segments) add(a, b);
    for (const auto& [a, b, c] : deformable.triangles) add(a, b), add(b, c), add(c, a);
    return count > 0 ? sum / count : 0;
}

/// Least integers of a box's places, on a grid whose places begin at `low`.
std::array<std::int64_t, 3> base_of(const Eigen::AlignedBox3d& box, const ParticleGrid& grid) {
    std::array<std::int64_t, 3> base{};
    if (box.isEmpty()) return base;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
        base[static_cast<std::size_t>(axis)] =
            std::llround((box.min()[axis] - grid.low[axis]) / grid.quantum);
    return base;
}

/// The 16 bits of a place on an axis; a place that is not finite is at the base.
std::uint16_t value_of(const Eigen::Vector3f& place, const ParticleGrid& grid, std::size_t frame,
                       std::size_t axis) {
    const std::int64_t base = grid.bases.empty() ? 0 : grid.bases[frame][axis];
    const auto i = static_cast<Eigen::Index>(axis);
    const double step = std::round((static_cast<double>(place[i]) - grid.low[i]) / grid.quantum) -
                        static_cast<double>(base);
    const auto above =
        static_cast<std::int64_t>(std::isfinite(step) ? std::clamp(step, 0.0, kMost) : 0.0);
    return static_cast<std::uint16_t>(base + above);
}

std::string channel(const ParticleMotion& motion, const ParticleGrid& grid, std::size_t axis) {
    std::string low, high;
    std::vector<std::uint16_t> neighbour(motion.frames());  // what the point before differed by
    for (std::size_t point = 0; point < motion.points; ++point) {
        std::uint16_t previous = 0, before = 0;
        for (std::size_t frame = 0; frame < neighbour.size(); ++frame) {
            const std::uint16_t value =
                value_of(motion.places[frame * motion.points + point], grid, frame, axis);
            const auto difference = static_cast<std::uint16_t>(value - 2 * previous + before);
            const std::uint16_t code =
                zigzag(static_cast<std::uint16_t>(difference - neighbour[frame]));
            low.push_back(static_cast<char>(code & 0xff));
            high.push_back(static_cast<char>(code >> 8));
            neighbour[frame] = difference;
            before = previous;
            previous = value;
        }
    }
    return low + high;
}

}  // namespace

ParticleGrid particle_grid(const RecordedDeformable& deformable, const ParticleMotion& motion) {
    Eigen::AlignedBox3d whole;
    double largest = 0;
    for (std::size_t frame = 0; frame < motion.frames(); ++frame) {
        const Eigen::AlignedBox3d box = box_of(motion, frame);
        if (box.isEmpty()) continue;
        whole.extend(box);
        largest = std::max(largest, box.sizes().maxCoeff());
    }
    ParticleGrid grid;
    if (whole.isEmpty()) return grid;
    const double edge = mean_edge(deformable, motion);
    const double finest = edge > 0 ? edge / kStepsAnEdge : deformable.size / kStepsASize;
    grid.low = whole.min();
    grid.quantum = std::max({largest / kMost, finest, 1e-12});
    if (whole.sizes().maxCoeff() / grid.quantum <= kMost) return grid;
    for (std::size_t frame = 0; frame < motion.frames(); ++frame)
        grid.bases.push_back(base_of(box_of(motion, frame), grid));
    return grid;
}

std::string encode_particles(const std::vector<ParticleMotion>& motions,
                             const std::vector<ParticleGrid>& grids) {
    std::string bytes;
    for (std::size_t i = 0; i < motions.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) bytes += channel(motions[i], grids[i], axis);
    return deflated(bytes);
}

}  // namespace plumb
