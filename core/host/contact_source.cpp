// SPDX-License-Identifier: MIT
#include "host/contact_source.h"

#include "host/add_bodies.h"
#include "scene/error.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <tuple>

namespace plumb {
namespace {

bool usable(const Contact& c, std::size_t bodies) {
    const double sum = c.gap + c.radius_a + c.radius_b + c.point_a.x + c.point_a.y + c.point_a.z +
                       c.point_b.x + c.point_b.y + c.point_b.z;
    const double length = to_eigen(c.normal).squaredNorm();
    return c.a < c.b && c.b < bodies && std::isfinite(sum) && std::abs(length - 1) < 1e-6;
}

bool before(const Contact& p, const Contact& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); }

const ColliderInfo& checked(const Scene& scene, const ColliderLibrary& colliders,
                            const std::string& name) {
    const ColliderInfo& info = colliders.find(name);
    colliders.check_abilities(info, scene);
    return info;
}

std::string text_of(const char* text) { return text ? text : ""; }

}  // namespace

void take_poses(std::vector<Pose>& poses, const World& world) {
    poses.resize(world.bodies.size());
    for (std::size_t i = 0; i < poses.size(); ++i)
        poses[i] = {to_plain(world.bodies.position[i]), to_plain(world.bodies.orientation[i])};
}

LocalSource::LocalSource(const Scene& scene, const ColliderLibrary& colliders,
                         const std::string& name)
    : world_(build_world(scene)) {
    const ColliderInfo& info = checked(scene, colliders, name);
    collider_ = colliders.create(info, 1);
    info_ = {info.name, text_of(info.table->backend_version), text_of(info.table->precision)};
    add_bodies(*collider_, world_, name);
}

ContactAnswer LocalSource::ask(const ContactQuestion& question) {
    ContactAnswer answer;
    room_.clear();
    const ContactSink sink = room_.sink();
    DetectRequest request{};
    request.poses = question.poses.data();
    request.body_count = static_cast<std::uint32_t>(question.poses.size());
    request.flags = question.raw ? kDetectRaw : 0u;
    request.margin = question.margin;
    request.sweeps = question.sweeps;

    const auto start = std::chrono::steady_clock::now();
    const Status status = collider_->detect(request, &sink, 1);
    answer.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    if (room_.overrun())
        throw ColliderError("collider \"" + info_.name +
                            "\" wrote more contacts than it had asked room for");
    answer.contacts.assign(room_.begin(), room_.end());
    answer.stats = collider_->stats();
    if (status.code != Status::ok)
        answer.trouble = status.message ? status.message : "it failed without a message";
    const auto left_out = std::erase_if(
        answer.contacts, [&](const Contact& c) { return !usable(c, question.poses.size()); });
    answer.rejected = static_cast<std::uint32_t>(left_out);
    if (!std::is_sorted(answer.contacts.begin(), answer.contacts.end(), before))
        std::stable_sort(answer.contacts.begin(), answer.contacts.end(), before);
    return answer;
}

}  // namespace plumb
