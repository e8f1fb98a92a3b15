// SPDX-License-Identifier: MIT
/// Where the two bodies of a pair are now: rotation matrices, which are quicker than quaternions
/// for more points than one, and made once for all pairs of a body.
#pragma once

#include "schedule/workers.h"
#include "world/bodies.h"
#include "world/kept_contacts.h"

#include <plumb/contact_set.h>

#include <vector>

namespace plumb {

inline BodyFrame frame_of(const Bodies& b, std::uint32_t body) {
    return {b.position[body], b.orientation[body].toRotationMatrix()};
}

/// Those of all bodies at their poses now, [body].
inline void find_frames(const Bodies& b, std::vector<BodyFrame>& frames, Workers& workers) {
    frames.resize(b.size());
    workers.each(b.size(), [&](std::uint32_t i, std::uint32_t) { frames[i] = frame_of(b, i); });
}

/// Of two frames, which must outlive it.
class PairPoses {
public:
    PairPoses(const BodyFrame& a, const BodyFrame& b) : a_(a), b_(b) {}
    PairPoses(const std::vector<BodyFrame>& frames, std::uint32_t a, std::uint32_t b)
        : PairPoses(frames[a], frames[b]) {}

    /// Points in the frames of a and b, in the world [m].
    Vector3d a_in_world(const Vector3d& point) const { return a_.at + a_.turn * point; }
    Vector3d b_in_world(const Vector3d& point) const { return b_.at + b_.turn * point; }

    /// Points of the world in the frames of a and b [m].
    Vector3d in_a(const Vector3d& point) const { return a_.turn.transpose() * (point - a_.at); }
    Vector3d in_b(const Vector3d& point) const { return b_.turn.transpose() * (point - b_.at); }

    /// Where a contact rides, and the contact brought to the poses now.
    ContactRide put_into_bodies(const Contact& c) const {
        return {to_plain(in_a(to_eigen(c.point_a))), to_plain(in_b(to_eigen(c.point_b))),
                to_plain(a_.turn.transpose() * to_eigen(c.normal))};
    }
    void put_into_world(Contact& c, const ContactRide& ride) const {
        const Vector3d on_a = a_in_world(to_eigen(ride.point_a)),
                       on_b = b_in_world(to_eigen(ride.point_b));
        const Vector3d n = a_.turn * to_eigen(ride.normal);
        c.point_a = to_plain(on_a), c.point_b = to_plain(on_b), c.normal = to_plain(n);
        c.gap = n.dot(on_a - on_b) - c.radius_a - c.radius_b;
    }

private:
    const BodyFrame &a_, &b_;
};

}  // namespace plumb
