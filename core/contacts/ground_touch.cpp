// SPDX-License-Identifier: MIT
#include "contacts/ground_touch.h"

#include <algorithm>

namespace plumb {
namespace {

bool stands_still(const Bodies& b, std::uint32_t body) {
    return b.motion[body] != Motion::dynamic && b.velocity[body].isZero(0) &&
           b.angular_velocity[body].isZero(0);
}

bool bounces(const ContactTable& c, const ContactPair& pair) {
    if (c.restitution.empty()) return false;
    const auto first = c.restitution.begin() + pair.first;
    return std::any_of(first, first + pair.count,
                       [](Restitution r) { return r != Restitution::none; });
}

}  // namespace

void GroundTouch::find(const World& world) {
    const Bodies& b = world.bodies;
    const ContactTable& c = world.contacts;
    touches_.assign(b.size(), nothing);
    const auto meet = [&](std::uint32_t body, std::uint32_t other, bool any_bounces) {
        const bool still = stands_still(b, other) && !any_bounces;
        if (!still || touches_[body] == nothing) touches_[body] = still ? still_only : else_too;
    };
    for (const ContactPair& pair : c.pairs) {
        const bool any = bounces(c, pair);
        meet(pair.a, pair.b, any);
        meet(pair.b, pair.a, any);
    }
    for (const Joint& joint : world.joints.joints)
        for (const std::uint32_t body : {joint.a, joint.b})
            if (body != kNoIndex) touches_[body] = else_too;
    const auto mark = [&](std::uint32_t body) { touches_[body] = else_too; };
    world.each_body_among_particles(mark);
    world.each_linked_body(true, mark);
}

}  // namespace plumb
