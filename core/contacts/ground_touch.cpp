// SPDX-License-Identifier: MIT
#include "contacts/ground_touch.h"

namespace plumb {
namespace {

bool stands_still(const Bodies& b, std::uint32_t body) {
    return b.motion[body] != Motion::dynamic && b.velocity[body].isZero(0) &&
           b.angular_velocity[body].isZero(0);
}

}  // namespace

void GroundTouch::find(const World& world) {
    const Bodies& b = world.bodies;
    const ContactTable& c = world.contacts;
    touches_.assign(b.size(), nothing);
    const auto meet = [&](std::uint32_t body, std::uint32_t other, bool bounces) {
        const bool still = stands_still(b, other) && !bounces;
        if (!still || touches_[body] == nothing) touches_[body] = still ? still_only : else_too;
    };
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        const bool bounces = !c.restitution.empty() && c.restitution[i] != Restitution::none;
        meet(c.found[i].a, c.found[i].b, bounces);
        meet(c.found[i].b, c.found[i].a, bounces);
    }
    for (const Joint& joint : world.joints.joints)
        for (const std::uint32_t body : {joint.a, joint.b})
            if (body != kNoIndex) touches_[body] = else_too;
    const auto mark = [&](std::uint32_t body) { touches_[body] = else_too; };
    world.each_body_among_particles(mark);
    world.each_linked_body(true, mark);
}

}  // namespace plumb
