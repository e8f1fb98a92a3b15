// SPDX-License-Identifier: MIT
/// The reference's narrow phase: one function for each pair of kinds, in closed form or by exact
/// separating axes.
///
/// Every function is written for the kinds in the order of its name (x first, y second); the
/// Emitter turns the answer round where the bodies stand the other way. Normals point out of y
/// towards x.
#pragma once

#include "manifold/contact_list.h"

namespace plumb::reference {

/// Where a pair function puts its points.
struct Emitter {
    ContactList& out;
    const Part &x, &y;
    bool swapped;   ///< x is the pair's b
    double margin;  ///< [m]

    /// Anchors, radii and gap as in contact_set.h, with x for a and y for b. Dropped beyond the
    /// margin.
    void point(Vec3 anchor_x, Vec3 anchor_y, Vec3 normal, double radius_x, double radius_y,
               std::uint64_t feature) const;
};

void plane_sphere(const Emitter& e);
void plane_box(const Emitter& e);
void plane_capsule(const Emitter& e);
void sphere_sphere(const Emitter& e);
void sphere_box(const Emitter& e);
void sphere_capsule(const Emitter& e);
void box_box(const Emitter& e);
void box_capsule(const Emitter& e);
void capsule_capsule(const Emitter& e);

/// Contacts of two parts, a before b.
void collide(ContactList& out, const Part& a, const Part& b);

/// Parameters of the closest points p + s·d and q + t·e of two segments, s and t in [0, 1].
struct SegmentPair {
    double s, t;
};
SegmentPair closest_of_segments(Vec3 p, Vec3 d, Vec3 q, Vec3 e);

/// A segment's two ends [m].
struct Segment {
    Vec3 from, to;
};
Segment core_of(const Part& capsule);

/// A box in the world.
struct Box {
    Vec3 centre, axis[3];
    double half[3];  ///< [m]
};
Box box_of(const Part& part);

}  // namespace plumb::reference
