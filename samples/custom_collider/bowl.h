// SPDX-License-Identifier: MIT
/// A collider of one's own: spheres inside a round bowl, which is no shape that Plumb knows.
///
/// In: poses of the bodies; the body of kind `plane` stands for the bowl, a hollow ball about its
/// place. Out: for each sphere near the wall the one contact, in closed form.
#pragma once

#include <plumb/proximity.h>

#include <cmath>
#include <map>

class Bowl : public plumb::Proximity {
public:
    explicit Bowl(double radius) : radius_(radius) {}
    virtual ~Bowl() = default;

    plumb::Status add(std::uint32_t body,
                      const plumb::ShapePlacement& placement) noexcept override {
        if (placement.shape.kind == plumb::ShapeKind::plane)
            bowl_ = body;
        else if (placement.shape.kind == plumb::ShapeKind::sphere)
            balls_[body] = placement.shape.radius;
        else
            return {plumb::Status::unsupported, 1, "only balls roll in this bowl"};
        return plumb::ok_status();
    }
    plumb::Status remove(std::uint32_t body) noexcept override {
        balls_.erase(body);
        if (body == bowl_) bowl_ = plumb::kNoBody;
        return plumb::ok_status();
    }
    plumb::Status exclude(std::uint32_t, std::uint32_t, bool) noexcept override {
        return plumb::ok_status();
    }
    plumb::DetectStats stats() const noexcept override { return stats_; }

    plumb::Status detect(const plumb::DetectRequest& request, const plumb::ContactSink* sinks,
                         std::uint32_t) noexcept override {
        stats_ = {};
        if (bowl_ == plumb::kNoBody) return plumb::ok_status();
        for (const auto& [ball, radius] : balls_) {
            const plumb::Contact contact = contact_of(request, ball, radius);
            const double sweep = request.sweeps ? request.sweeps[ball] : 0;
            if (contact.gap > request.margin + sweep) continue;
            plumb::Contact* room = sinks[0].grow(sinks[0].ctx, 1);
            if (!room) return {plumb::Status::out_of_memory, 1, "the sink takes no more"};
            *room = contact;
            ++stats_.narrow_pairs;
        }
        return plumb::ok_status();
    }

private:
    /// The wall's point straight out from the bowl's centre. The normal points out of b towards a.
    plumb::Contact contact_of(const plumb::DetectRequest& request, std::uint32_t ball,
                              double radius) const {
        const plumb::Vec3 o = request.poses[bowl_].position, c = request.poses[ball].position;
        const double x = c.x - o.x, y = c.y - o.y, z = c.z - o.z;
        const double away = std::sqrt(x * x + y * y + z * z);
        const plumb::Vec3 out =
            away > 0 ? plumb::Vec3{x / away, y / away, z / away} : plumb::Vec3{0, -1, 0};
        const plumb::Vec3 wall{o.x + radius_ * out.x, o.y + radius_ * out.y, o.z + radius_ * out.z};

        plumb::Contact contact{};
        contact.a = bowl_;  // the bowl is added first, so that a < b
        contact.b = ball;
        contact.feature = 1;
        contact.point_a = wall;
        contact.point_b = c;
        contact.radius_b = radius;
        contact.normal = out;
        contact.gap = radius_ - away - radius;
        contact.flags = plumb::kContactExact;
        return contact;
    }

    double radius_;  // of the bowl [m]
    std::uint32_t bowl_ = plumb::kNoBody;
    std::map<std::uint32_t, double> balls_;  // body → radius [m]
    plumb::DetectStats stats_{};
};
