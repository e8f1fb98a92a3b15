// SPDX-License-Identifier: MIT
/// Contacts, as arrays that the core owns and a collider fills.
#pragma once

#include <plumb/shape.h>

#include <cstdint>

namespace plumb {

/// Where a contact's numbers come from.
enum ContactFlags : std::uint32_t {
    kContactExact = 1u << 0,    ///< closed form or exact separating axes
    kContactClipped = 1u << 1,  ///< back-end's normal, points by clipping the true support faces
    kContactApproximate =
        1u << 2,  ///< the back-end is known to err here (deep overlap, iteration limit)
    kContactFallback = 1u << 3  ///< clipping found nothing better than the back-end's own witness
};

/// One contact point between two bodies, in the world frame.
///
/// Signs, everywhere in Plumb: the normal points out of b towards a, the gap is negative when the
/// bodies overlap. A round shape is anchored on its core (centre of a sphere, segment of a capsule)
/// and `radius_*` tells how far the surface lies from it, so that a rolling sphere keeps its true
/// gap while the step moves it:
///
///     surface point of a = point_a − radius_a · normal
///     surface point of b = point_b + radius_b · normal
///     gap = normal · (point_a − point_b) − radius_a − radius_b
///
/// A sharp shape has radius 0 and its anchor on the surface. The two surface points differ by gap ·
/// normal.
struct Contact {
    std::uint32_t a, b;     ///< body ids, a < b
    std::uint64_t feature;  ///< the same while the same features touch; 0 = unknown. Unique within
                            ///< a pair unless 0
    Vec3 point_a, point_b;  ///< anchors [m]
    Vec3 normal;            ///< unit, out of b towards a
    double gap;             ///< [m], negative when penetrating
    double radius_a, radius_b;     ///< [m], 0 where sharp
    std::uint32_t flags;           ///< ContactFlags
    std::uint32_t part_a, part_b;  ///< part of a compound, triangle of a mesh; else 0
    std::uint32_t reserved;        ///< zero
};

/// Most contacts that a sink takes in one detection (512 MiB).
inline constexpr std::uint32_t kMaxContacts = 1u << 22;

/// Where a collider puts what it found. `grow(ctx, n)` returns room for n more contacts, next to
/// each other, or nullptr when the core will take no more (kMaxContacts in all, or memory ran out);
/// it never throws. The room stays valid until the next call of `grow` on the same sink. Nothing
/// may be written behind it: the core looks, and does without a collider that did.
struct ContactSink {
    void* ctx;
    Contact* (*grow)(void* ctx, std::uint32_t count);
};

}  // namespace plumb
