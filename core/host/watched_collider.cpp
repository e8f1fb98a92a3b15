// SPDX-License-Identifier: MIT
#include "host/watched_collider.h"

#include "host/collider_call.h"

namespace plumb {

WatchedCollider::~WatchedCollider() {
    const ColliderCall call(table_.name, "destroy");
    table_.destroy(&collider_);
}

Status WatchedCollider::add(std::uint32_t body, const ShapePlacement& placement) noexcept {
    const ColliderCall call(table_.name, "add");
    return collider_.add(body, placement);
}

Status WatchedCollider::remove(std::uint32_t body) noexcept {
    const ColliderCall call(table_.name, "remove");
    return collider_.remove(body);
}

Status WatchedCollider::exclude(std::uint32_t a, std::uint32_t b, bool excluded) noexcept {
    const ColliderCall call(table_.name, "exclude");
    return collider_.exclude(a, b, excluded);
}

Status WatchedCollider::detect(const DetectRequest& request, const ContactSink* sinks,
                               std::uint32_t sink_count) noexcept {
    const ColliderCall call(table_.name, "detect");
    const Status status = collider_.detect(request, sinks, sink_count);
    stats_ = collider_.stats();
    return status;
}

Status WatchedCollider::cast_rays(const RayRequest* rays, RayHit* hits,
                                  std::uint32_t count) noexcept {
    const ColliderCall call(table_.name, "cast_rays");
    return collider_.cast_rays(rays, hits, count);
}

Status WatchedCollider::closest(std::uint32_t a, std::uint32_t b, Contact* result) noexcept {
    const ColliderCall call(table_.name, "closest");
    return collider_.closest(a, b, result);
}

Status WatchedCollider::detect_particles(const ParticleRequest& request, const ContactSink* sinks,
                                         std::uint32_t sink_count) noexcept {
    const ColliderCall call(table_.name, "detect_particles");
    return collider_.detect_particles(request, sinks, sink_count);
}

}  // namespace plumb
