// SPDX-License-Identifier: MIT
/// Where the two bodies of a pair are now: rotation matrices, which are quicker than quaternions
/// for more points than one, and made once for all pairs of a body.
#pragma once

#include "world/bodies.h"
#include "world/kept_contacts.h"

#include <plumb/contact_set.h>

#include <vector>

namespace plumb {

inline BodyFrame frame_of(const Bodies& b, std::uint32_t body) {
    return {b.position[body], b.orientation[body].toRotationMatrix()};
}

/// Those of all bodies at their poses now, [body].
inline void find_frames(const Bodies& b, std::vector<BodyFrame>& frames) {
    frames.resize(b.size());
    for (std::uint32_t i = 0; i < b.size(); ++i) frames[i] = frame_of(b, i);
}

class PairPoses {
public:
    PairPoses(const BodyFrame& a, const BodyFrame& b)
        : at_a_(a.at), at_b_(b.at), turn_a_(a.turn), turn_b_(b.turn) {}
    PairPoses(const std::vector<BodyFrame>& frames, std::uint32_t a, std::uint32_t b)
        : PairPoses(frames[a], frames[b]) {}
    PairPoses(const Bodies& bodies, std::uint32_t a, std::uint32_t b)
        : PairPoses(frame_of(bodies, a), frame_of(bodies, b)) {}

    /// Points in the frames of a and b, in the world [m].
    Vector3d a_in_world(const Vector3d& point) const { return at_a_ + turn_a_ * point; }
    Vector3d b_in_world(const Vector3d& point) const { return at_b_ + turn_b_ * point; }

    /// Points of the world in the frames of a and b [m].
    Vector3d in_a(const Vector3d& point) const { return turn_a_.transpose() * (point - at_a_); }
    Vector3d in_b(const Vector3d& point) const { return turn_b_.transpose() * (point - at_b_); }

    /// Where a contact rides, and the contact brought to the poses now.
    ContactRide put_into_bodies(const Contact& c) const {
        return {to_plain(in_a(to_eigen(c.point_a))), to_plain(in_b(to_eigen(c.point_b))),
                to_plain(turn_a_.transpose() * to_eigen(c.normal))};
    }
    void put_into_world(Contact& c, const ContactRide& ride) const {
        const Vector3d on_a = a_in_world(to_eigen(ride.point_a)),
                       on_b = b_in_world(to_eigen(ride.point_b));
        const Vector3d n = turn_a_ * to_eigen(ride.normal);
        c.point_a = to_plain(on_a), c.point_b = to_plain(on_b), c.normal = to_plain(n);
        c.gap = n.dot(on_a - on_b) - c.radius_a - c.radius_b;
    }

private:
    Vector3d at_a_, at_b_;
    Matrix3d turn_a_, turn_b_;
};

}  // namespace plumb
