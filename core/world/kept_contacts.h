// SPDX-License-Identifier: MIT
/// Contacts that stay in their table from step to step while the two bodies of a pair stand still
/// to each other.
#pragma once

#include <plumb/contact_set.h>

#include "math/types.h"

#include <cstdint>
#include <vector>

namespace plumb {

/// What a walk over all pairs reads of one.
struct KeptPair {
    std::uint32_t a, b;          ///< bodies, a < b
    std::uint32_t first, count;  ///< its contacts in the table; `first` within a detection alone
    bool fresh;                  ///< its narrow phase runs in this step
    double margin;               ///< gaps up to it were asked for [m]
    double reach;                ///< |PairPose::offset| and the smaller body's radius [m]
    double moved;                ///< bound on how far its points have come since [m]
};

/// How the bodies of a pair stood to each other when its narrow phase ran.
struct PairPose {
    Vector3d offset;   ///< the smaller body's centre of mass in the other's frame [m]
    Quaterniond turn;  ///< the smaller body's frame → the other's
};

/// Where a contact rides: point_a and normal in a's frame, point_b in b's frame.
struct ContactRide {
    Vec3 point_a, point_b, normal;  ///< [m], [m], unit
};

/// A body's centre of mass [m], and its frame's axes as columns.
struct BodyFrame {
    Vector3d at;
    Matrix3d turn;
};

/// Contacts that stand side by side in the table and move together.
struct ContactMove {
    std::uint32_t from, to, count;
};

/// Without reuse there are no pairs, poses and rides.
struct KeptContacts {
    std::vector<KeptPair> pairs;     ///< sorted by (a, b); those without a contact as well
    std::vector<PairPose> poses;     ///< [pair]
    std::vector<ContactRide> rides;  ///< [contact]; empty where nothing is kept
    std::vector<Pose> seen;          ///< [body] at the last detection
    std::uint64_t reused = 0;        ///< contacts that were kept in this step

    // memory of a detection
    std::vector<KeptPair> born;        ///< pairs that were no candidates in the step before
    std::vector<PairPose> born_poses;  ///< [born]
    std::vector<ContactMove> stays;    ///< kept contacts: where they stood, where they will
    std::vector<ContactMove> comes;    ///< detected ones: from ContactTable::fresh to the table
};

}  // namespace plumb
