// SPDX-License-Identifier: MIT
#include "manifold/queries.h"

#include "manifold/ball_contact.h"
#include "manifold/guarded.h"

namespace plumb {
namespace {

bool usable(const RayRequest& ray) {
    return finite(ray.origin) && finite(ray.direction) && ray.length >= 0 &&
           std::abs(dot(ray.direction, ray.direction) - 1) < 1e-6;
}

bool usable(const ParticleRequest& request, std::uint32_t i) {
    return finite(request.positions[i]) && std::isfinite(request.radii[i]) && request.radii[i] >= 0;
}

Aabb around(Vec3 centre, double reach) {
    const Vec3 grown{reach, reach, reach};
    return {centre - grown, centre + grown};
}

}  // namespace

void Queries::refresh() {
    if (known_ && version_ == table_.version()) return;
    bounded_.clear();
    unbounded_.clear();
    std::vector<Aabb> boxes;
    for (std::uint32_t i = 0; i < table_.parts().size(); ++i) {
        const Part& part = table_.parts()[i];
        if (!part.present) continue;
        const Aabb box = bounds_of(part);
        if (finite(box.low) && finite(box.high)) {
            bounded_.push_back(i);
            boxes.push_back(box);
        } else {
            unbounded_.push_back(i);
        }
    }
    tree_ = BoxTree(boxes);
    known_ = true;
    version_ = table_.version();
}

void Queries::touch(Share& share, const ParticleRequest& request, std::uint32_t particle) const {
    const Vec3 centre = request.positions[particle];
    const double radius = request.radii[particle], reach = radius + request.margin;
    share.near = unbounded_;
    tree_.overlapping(around(centre, reach),
                      [&](std::uint32_t item) { share.near.push_back(bounded_[item]); });
    std::sort(share.near.begin(), share.near.end());
    for (std::uint32_t i : share.near) {
        const Part& part = table_.parts()[i];
        if (!(request.group & part.mask) || !(part.group & request.mask)) continue;
        SurfacePoint nearest;
        if (!signed_distance(nearest, part, centre, reach)) continue;
        if (!(nearest.distance - radius <= request.margin)) continue;
        Contact& c = share.contacts.add_particle(particle, part);
        fill_ball_contact(c, centre, radius, part, nearest);
        c.feature = feature_key({6, part.index});
    }
}

void Queries::run_share(Share& share, const ParticleRequest& request, std::uint32_t first,
                        std::uint32_t last) const {
    share.contacts.clear();
    share.bad = 0;
    share.status = guarded([&] {
        for (std::uint32_t i = first; i < last; ++i) {
            if (usable(request, i))
                touch(share, request, i);
            else
                ++share.bad;
        }
        share.contacts.finish();
        return ok_status();
    });
}

Status Queries::detect_particles(const ParticleRequest& request, const ContactSink* sinks,
                                 std::uint32_t sink_count, std::uint32_t threads) {
    if (!sinks || !sink_count) return {Status::bad_argument, 0, "particles need a sink"};
    if (!(request.margin >= 0) || !std::isfinite(request.margin) ||
        (request.count && (!request.positions || !request.radii)))
        return {Status::bad_argument, 0,
                "particles need positions, radii and a finite margin of at least 0"};
    refresh();
    const TaskRunner* runner = request.runner;
    shares_.resize(runner ? std::max(1u, std::min({threads, runner->workers, sink_count})) : 1);
    auto task = [&](std::uint32_t worker) {
        if (worker >= shares_.size()) return;
        const auto begin = [&](std::uint64_t w) {
            return static_cast<std::uint32_t>(request.count * w / shares_.size());
        };
        run_share(shares_[worker], request, begin(worker), begin(worker + 1));
    };
    if (shares_.size() == 1)
        task(0);
    else
        runner->run(
            runner->ctx,
            [](void* arg, std::uint32_t worker) { (*static_cast<decltype(task)*>(arg))(worker); },
            &task);

    Status status = ok_status();
    std::uint32_t bad = 0;
    for (std::size_t i = 0; i < shares_.size(); ++i) {
        const Status written = shares_[i].contacts.write_to(sinks[i]);
        status = worse_of(worse_of(status, shares_[i].status), written);
        bad += shares_[i].bad;
    }
    if (status.code != Status::ok || !bad) return status;
    return {Status::bad_argument, bad,
            "particles whose place or radius is not finite, or whose radius is negative, were left "
            "out"};
}

RayHit Queries::first_hit(const RayRequest& request) const {
    RayHit best{kNoBody, 0, request.length, {0, 0, 0}};
    std::uint32_t best_part = kNoBody;
    const Ray ray = make_ray(request.origin, request.direction);
    const auto ask = [&](std::uint32_t i) {
        const Part& part = table_.parts()[i];
        PartHit hit;
        if (!(part.group & request.mask) || !cast_ray(hit, part, ray, best.distance)) return;
        if (hit.distance == best.distance && i > best_part) return;
        best = {part.body, part.in_compound ? part.index : hit.triangle, hit.distance, hit.normal};
        best_part = i;
    };
    for (std::uint32_t i : unbounded_) ask(i);
    tree_.along(
        ray, [&] { return best.distance; }, [&](std::uint32_t item) { ask(bounded_[item]); });
    return best;
}

Status Queries::cast_rays(const RayRequest* rays, RayHit* hits, std::uint32_t count) {
    if (count && (!rays || !hits)) return {Status::bad_argument, 0, "rays need room for hits"};
    refresh();
    std::uint32_t bad = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (usable(rays[i])) {
            hits[i] = first_hit(rays[i]);
        } else {
            hits[i] = {kNoBody, 0, 0, {0, 0, 0}};
            ++bad;
        }
    }
    if (!bad) return ok_status();
    return {Status::bad_argument, bad,
            "rays hit nothing whose numbers are not finite, whose direction is not of length 1 or "
            "whose length is negative"};
}

}  // namespace plumb
