// SPDX-License-Identifier: MIT
/// Many separate near pairs of two kinds of shapes of unit size, to be detected by one plugin.
#pragma once

#include "host/collider_library.h"

#include <vector>

namespace plumb::bench {

/// 216 pairs, each in a place of its own. Half stand on each other, turned about the vertical and
/// beside each other by a little; half meet in any direction. Their gaps are spread from −2 to
/// +2 mm, and each detection moves one body of each pair by some hundredths of a millimetre.
/// Surfaces (planes, meshes, height fields) rest below; the lower of two meshes moves.
class NearPairs {
public:
    NearPairs(const ColliderLibrary& library, const ColliderInfo& plugin, ShapeKind a, ShapeKind b);

    /// Time of one detection over the number of pairs [ns].
    double detect();

    /// Pairs with a contact at the last detection.
    std::size_t touching() const;

private:
    struct Pair {
        std::uint32_t upper;
        Vec3 place;   ///< of the upper body at the gap that it shall have [m]
        Vec3 normal;  ///< out of the lower body
    };
    void add(std::uint32_t body, ShapeKind kind, bool upper, const Pose& pose);
    void add_pairs(ShapeKind a, ShapeKind b);
    void bring_near();
    void ask();

    ProximityPtr proximity_;
    std::vector<Pose> poses_;
    std::vector<Pair> pairs_;
    std::vector<Contact> contacts_;
    std::size_t found_ = 0;  ///< contacts of the last detection
    bool plane_ = false;     ///< body 0 lies below all pairs
    unsigned calls_ = 0;
};

}  // namespace plumb::bench
