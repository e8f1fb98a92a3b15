// SPDX-License-Identifier: MIT
#include "world/build_links.h"

#include "scene/error.h"
#include "world/build_joints.h"
#include "world/point_place.h"

#include <string>

namespace plumb {
namespace {

std::uint32_t particle_of(const World& world, std::uint32_t deformable, std::uint32_t point,
                          const std::string& place) {
    if (deformable >= world.deformables.size())
        throw SceneError("", place, "there is no such deformable");
    const Deformable& d = world.deformables[deformable];
    if (point >= d.count)
        throw SceneError("", place,
                         "has point " + std::to_string(point) + ", and the deformable has only " +
                             std::to_string(d.count));
    return d.first + point;
}

WorldPoint on_body(const World& world, std::uint32_t body, const Vector3d& position,
                   const std::string& place) {
    WorldPoint point;
    point.position = position;
    if (body == kNoIndex) return point;
    if (body >= world.bodies.size()) throw SceneError("", place, "there is no such body");
    point.body = body;
    point.position = in_body(world.bodies, body, position);
    return point;
}

WorldPoint world_point(const World& world, const ScenePoint& p, const std::string& place) {
    if (p.deformable == kNoIndex) return on_body(world, p.body, p.position, place);
    WorldPoint point;
    point.particle = particle_of(world, p.deformable, p.point, place);
    return point;
}

void attach(World& world, const AttachmentSpec& spec, const std::string& place) {
    const bool moves = spec.body != kNoIndex && spec.body < world.bodies.size() &&
                       world.bodies.motion[spec.body] != Motion::fixed;
    for (std::size_t i = 0; i < spec.points.size(); ++i) {
        Link link;
        link.joins = true, link.compliance = spec.compliance;
        link.a.particle = particle_of(world, spec.deformable, spec.points[i],
                                      place + "/points/" + std::to_string(i));
        link.b = on_body(world, spec.body, place_of(world, link.a), place + "/body");
        if (moves || spec.compliance > 0) {
            world.links.push_back(link);
            continue;
        }
        world.particles.inverse_mass[link.a.particle] = 0;
        world.particles.velocity[link.a.particle].setZero();
    }
}

JointDraft rod_joint(const World& world, const Link& link, const std::string& place) {
    JointSpec spec;
    spec.kind = JointKind::distance;
    const bool swapped = link.a.body == kNoIndex;
    const WorldPoint &a = swapped ? link.b : link.a, &b = swapped ? link.a : link.b;
    spec.body_a = a.body, spec.body_b = b.body;
    spec.anchor = place_of(world, a), spec.anchor_b = place_of(world, b);
    spec.collide = true;
    JointDraft draft = make_joint(world, spec, place);
    draft.joint.length = link.longest;
    return draft;
}

}  // namespace

bool is_rod(const Scene& scene, const LinkSpec& link) {
    const auto moves = [&](const ScenePoint& p) {
        return p.body != kNoIndex && scene.bodies[p.body].motion == Motion::dynamic;
    };
    return link.a.deformable == kNoIndex && link.b.deformable == kNoIndex &&
           link.shortest == link.longest && link.compliance == 0 &&
           (moves(link.a) || moves(link.b));
}

void build_links(World& world, const Scene& scene) {
    for (std::size_t i = 0; i < scene.attachments.size(); ++i)
        attach(world, scene.attachments[i], "/attachments/" + std::to_string(i));
    for (std::size_t i = 0; i < scene.links.size(); ++i) {
        const std::string place = "/links/" + std::to_string(i);
        const LinkSpec& spec = scene.links[i];
        Link link;
        link.a = world_point(world, spec.a, place + "/a");
        link.b = world_point(world, spec.b, place + "/b");
        const double apart = (place_of(world, link.a) - place_of(world, link.b)).norm();
        const bool keeps_length = !spec.shortest && !spec.longest;
        link.shortest = keeps_length ? apart : spec.shortest.value_or(0);
        link.longest = keeps_length ? apart : spec.longest.value_or(std::max(apart, 1e9));
        link.compliance = spec.compliance, link.damping = spec.damping;
        if (!(link.shortest >= 0) || !(link.longest >= link.shortest) || !(link.longest > 0))
            throw SceneError("", place,
                             "its lengths must be 0 ≤ shortest ≤ longest, and not both 0");
        if (!(link.compliance >= 0) || !(link.damping >= 0))
            throw SceneError("", place, "compliance and damping must not be negative");
        if (is_rod(scene, spec))
            append_joint(world, rod_joint(world, link, place));
        else
            world.links.push_back(link);
    }
}

}  // namespace plumb
