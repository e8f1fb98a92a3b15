// SPDX-License-Identifier: MIT
/// Structures of loose boxes that statics says must stand.
#pragma once

#include "scene/build.h"
#include "scene/scene.h"
#include "support/random.h"

#include <vector>

namespace plumb::test {

/// A box of a structure: half extents and centre [m].
struct Block {
    Eigen::Vector3d half, centre;
};
using Structure = std::vector<Block>;

/// n equal boxes on top of each other.
inline Structure tower(int n, const Eigen::Vector3d& half) {
    Structure s;
    for (int i = 0; i < n; ++i) s.push_back({half, {0, half.y() * (2 * i + 1), 0}});
    return s;
}

/// n boxes of drawn sizes on top of each other.
inline Structure mixed_tower(int n, unsigned seed) {
    Random random(seed);
    Structure s;
    double top = 0;
    for (int i = 0; i < n; ++i) {
        const double x = random.number(0.3, 0.6), y = random.number(0.1, 0.4);
        s.push_back({{x, y, random.number(0.3, 0.6)}, {0, top + y, 0}});
        top += 2 * y;
    }
    return s;
}

/// Rows of boxes, each a box shorter than the one below; `gap` between neighbours [m].
inline Structure pyramid(int rows, const Eigen::Vector3d& half, double gap) {
    Structure s;
    const double pitch = 2 * half.x() + gap;
    for (int r = 0; r < rows; ++r)
        for (int i = 0; i < rows - r; ++i)
            s.push_back({half, {pitch * (i - 0.5 * (rows - r - 1)), half.y() * (2 * r + 1), 0}});
    return s;
}

/// Courses of bricks in running bond, with half bricks at the ends of every other course.
inline Structure wall(int bricks, int courses, const Eigen::Vector3d& half, double gap) {
    Structure s;
    const double pitch = 2 * half.x() + gap;
    const Eigen::Vector3d small(0.5 * half.x() - 0.25 * gap, half.y(), half.z());
    for (int c = 0; c < courses; ++c) {
        const double y = half.y() * (2 * c + 1), first = small.x() + 0.5 * gap;
        if (c % 2 == 0) {
            for (int i = 0; i < bricks; ++i) s.push_back({half, {pitch * (i + 0.5), y, 0}});
            continue;
        }
        s.push_back({small, {first, y, 0}});
        for (int i = 1; i < bricks; ++i) s.push_back({half, {pitch * i, y, 0}});
        s.push_back({small, {pitch * bricks - first, y, 0}});
    }
    return s;
}

/// A board on four legs.
inline Structure table() {
    Structure s;
    for (double x : {-0.8, 0.8})
        for (double z : {-0.4, 0.4}) s.push_back({{0.05, 0.4, 0.05}, {x, 0.4, z}});
    s.push_back({{1, 0.03, 0.6}, {0, 0.83, 0}});
    return s;
}

/// Two posts and a lintel, storeys on top of each other.
inline Structure gate(int storeys) {
    Structure s;
    for (int i = 0; i < storeys; ++i) {
        const double y = 1.2 * i;
        for (double x : {-0.6, 0.6}) s.push_back({{0.15, 0.5, 0.2}, {x, y + 0.5, 0}});
        s.push_back({{0.9, 0.1, 0.25}, {0, y + 1.1, 0}});
    }
    return s;
}

/// Columns of crates that fall by 0.3 m first.
inline Structure crates() {
    Random random(1);
    Structure s;
    for (int x = 0; x < 5; ++x)
        for (int y = 0; y < 4; ++y)
            for (int z = 0; z < 5; ++z)
                s.push_back({{0.2, 0.2, 0.2},
                             {0.6 * x + random.number(-0.02, 0.02),
                              0.5 + 0.6 * y + random.number(-0.02, 0.02),
                              0.6 * z + random.number(-0.02, 0.02)}});
    return s;
}

/// Moves each block aside by up to `most` [m] in either direction.
inline Structure unevenly(Structure s, double most, unsigned seed) {
    Random random(seed);
    for (Block& b : s)
        b.centre += Eigen::Vector3d(random.number(-most, most), 0, random.number(-most, most));
    return s;
}

/// Adds the structure's blocks behind the scene's bodies.
inline void add_structure(Scene& scene, const Structure& structure) {
    for (const Block& b : structure) add_body(scene, box(b.half), b.centre);
}

}  // namespace plumb::test
