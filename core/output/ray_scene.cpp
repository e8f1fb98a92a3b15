// SPDX-License-Identifier: MIT
#include "output/ray_scene.h"

#include "output/triangles.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace plumb {
namespace {

void commit_into(RTCScene scene, RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

/// A ball that is one, not triangles.
RTCGeometry ball(RTCDevice device, double radius) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* point = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
    std::fill(point, point + 3, 0.0f);
    point[3] = static_cast<float>(radius);
    return geometry;
}

RTCGeometry triangles(RTCDevice device, const TriangleMesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        std::copy_n(mesh.vertices[i].data(), 3, vertices + 3 * i);
    }
    auto* corners = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        std::copy_n(mesh.triangles[i].data(), 3, corners + 3 * i);
    }
    return geometry;
}

TriangleMesh square(double reach) {
    const auto r = static_cast<float>(reach);
    return {{{-r, 0, -r}, {-r, 0, r}, {r, 0, r}, {r, 0, -r}}, {{0, 1, 2}, {0, 2, 3}}};
}

Eigen::Vector3f capsule_normal(const Eigen::Vector3f& p, float half) {
    return {p.x(), p.y() - std::clamp(p.y(), -half, half), p.z()};
}

/// Slope of the surface about a point of the grid, in (x, z).
Eigen::Vector2f slope_at(const Geometry& g, std::uint32_t row, std::uint32_t column) {
    const auto height = [&g](std::uint32_t r, std::uint32_t c) {
        return g.heights[std::size_t{r} * g.columns + c];
    };
    const std::uint32_t left = column > 0 ? column - 1 : 0,
                        right = std::min(column + 1, g.columns - 1);
    const std::uint32_t back = row > 0 ? row - 1 : 0, front = std::min(row + 1, g.rows - 1);
    return {static_cast<float>((height(row, right) - height(row, left)) /
                               ((right - left) * g.spacing_x)),
            static_cast<float>((height(front, column) - height(back, column)) /
                               ((front - back) * g.spacing_z))};
}

/// Upward normal of a height field, whose slopes are blended between the points of its grid.
Eigen::Vector3f height_field_normal(const Geometry& g, const Eigen::Vector3f& p) {
    const auto cell = [](double place, double spacing, std::uint32_t count) {
        return std::clamp(place / spacing + 0.5 * (count - 1), 0.0, count - 1.001);
    };
    const double x = cell(static_cast<double>(p.x()), g.spacing_x, g.columns);
    const double z = cell(static_cast<double>(p.z()), g.spacing_z, g.rows);
    const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(z);
    const auto u = static_cast<float>(x - column), v = static_cast<float>(z - row);
    const Eigen::Vector2f slope =
        (1 - v) * ((1 - u) * slope_at(g, row, column) + u * slope_at(g, row, column + 1)) +
        v * ((1 - u) * slope_at(g, row + 1, column) + u * slope_at(g, row + 1, column + 1));
    return {-slope.x(), 1, -slope.y()};
}

/// Normal of the true round surface, of which the triangles are but an outline; flat parts keep
/// theirs.
Eigen::Vector3f true_normal(const Geometry& g, const Eigen::Vector3f& p, Eigen::Vector3f flat) {
    const auto radius = static_cast<float>(g.radius), half = static_cast<float>(g.half_height);
    const Eigen::Vector3f radial(p.x(), 0, p.z());
    switch (g.kind) {
        case ShapeKind::sphere:
            return p;
        case ShapeKind::capsule:
            return capsule_normal(p, half);
        case ShapeKind::cylinder:
            return std::abs(flat.normalized().y()) > 0.9f ? flat : radial;
        case ShapeKind::cone:
            if (flat.normalized().y() < -0.999f || radial.squaredNorm() == 0) return flat;
            return radial.normalized() * 2 * half + Eigen::Vector3f(0, radius, 0);
        case ShapeKind::height_field:
            return height_field_normal(g, p);
        default:
            return flat;
    }
}

RTCRay ray_of(const Eigen::Vector3f& from, const Eigen::Vector3f& direction) {
    RTCRay ray{};
    ray.org_x = from.x(), ray.org_y = from.y(), ray.org_z = from.z();
    ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
    ray.tfar = std::numeric_limits<float>::infinity();
    ray.mask = ~0u;
    return ray;
}

}  // namespace

RayScene::RayScene(const RecordingHeader& header, const Frame& frame, const Eigen::Vector3d& middle,
                   double reach, double thinnest)
    : middle_(middle), reach_(reach), device_(rtcNewDevice(nullptr)) {
    if (!device_) throw std::runtime_error("Embree cannot be started");
    scene_.reset(rtcNewScene(device_.get()));
    add_bodies(header, frame);
    if (frame.particles.size() == particle_count(header.deformables)) {
        add_deformables(header, frame, thinnest);
        add_links(header, frame, thinnest);
    }
    rtcCommitScene(scene_.get());
}

void RayScene::add_bodies(const RecordingHeader& header, const Frame& frame) {
    const std::size_t count = std::min(header.bodies.size(), frame.bodies.size());
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t geometry = header.bodies[i].geometry;
        const Placement& placement = frame.bodies[i].placement;
        if (geometry >= header.geometries.size() || !placement.position.allFinite()) continue;
        add(header.geometries[geometry], placement, static_cast<std::uint32_t>(i));
    }
}

void RayScene::add_deformables(const RecordingHeader& header, const Frame& frame, double thinnest) {
    for (std::uint32_t i = 0; i < header.deformables.size(); ++i) {
        const RecordedDeformable& deformable = header.deformables[i];
        Item item{{Drawn::Kind::deformable, i}};
        if (deformable.kind == DeformableKind::rope) {
            std::vector<Piece> rope;
            for (const auto& segment : segments_in(deformable, frame)) {
                const auto end = [&](std::size_t k) -> Eigen::Vector3f {
                    return (frame.particles[deformable.first + segment[k]] - middle_).cast<float>();
                };
                rope.push_back({end(0), end(1)});
            }
            add(std::move(item), pieces(rope, std::max(rope_radius(deformable), thinnest)));
        } else if ((item.surface = surface_of(deformable, frame, middle_))) {
            const RTCGeometry geometry = triangles(device_.get(), item.surface->mesh());
            add(std::move(item), geometry);
        }
    }
}

void RayScene::add_links(const RecordingHeader& header, const Frame& frame, double thinnest) {
    std::vector<Piece> links;
    for (const RecordedLink& link : header.links)
        links.push_back({(place_of(link.a, frame) - middle_).cast<float>(),
                         (place_of(link.b, frame) - middle_).cast<float>()});
    add({{Drawn::Kind::link, 0}}, pieces(links, thinnest));
}

void RayScene::add(const Geometry& geometry, const Placement& placement, std::uint32_t body) {
    if (geometry.kind == ShapeKind::compound) {
        for (const GeometryPart& part : geometry.parts) {
            Placement placed;
            placed.position = placement.position + placement.rotation * part.local.position;
            placed.rotation = placement.rotation * part.local.rotation;
            add(part.geometry, placed, body);
        }
        return;
    }
    const Item item{{Drawn::Kind::body, body},
                    &geometry,
                    placement.rotation.normalized().toRotationMatrix().cast<float>(),
                    (placement.position - middle_).cast<float>()};
    if (!item.rotation.allFinite()) return;
    RTCGeometry instance = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, form(geometry));
    Eigen::Matrix<float, 3, 4> transform;
    transform << item.rotation, item.position;
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
    add(item, instance);
}

void RayScene::add(Item item, RTCGeometry geometry) {
    commit_into(scene_.get(), geometry);
    items_.push_back(std::move(item));
}

/// Round from end to end, pieces that are not finite left out.
RTCGeometry RayScene::pieces(const std::vector<Piece>& pieces, double radius) {
    std::vector<float> ends;
    for (const auto& [a, b] : pieces) {
        if (!a.allFinite() || !b.allFinite()) continue;
        for (const Eigen::Vector3f& end : {a, b})
            ends.insert(ends.end(), {end.x(), end.y(), end.z(), static_cast<float>(radius)});
    }
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                4 * sizeof(float), ends.size() / 4));
    std::copy(ends.begin(), ends.end(), vertices);
    auto* firsts = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT,
                                sizeof(std::uint32_t), ends.size() / 8));
    for (std::uint32_t i = 0; i < ends.size() / 8; ++i) firsts[i] = 2 * i;
    return geometry;
}

RTCScene RayScene::form(const Geometry& geometry) {
    Scene& scene = forms_[&geometry];
    if (scene) return scene.get();
    scene.reset(rtcNewScene(device_.get()));
    if (geometry.kind == ShapeKind::sphere) {
        commit_into(scene.get(), ball(device_.get(), geometry.radius));
    } else {
        const bool plane = geometry.kind == ShapeKind::plane;
        const TriangleMesh mesh = plane ? square(reach_) : triangles_of(geometry);
        if (!mesh.triangles.empty()) commit_into(scene.get(), triangles(device_.get(), mesh));
    }
    rtcCommitScene(scene.get());
    return scene.get();
}

std::optional<RaySurface> RayScene::nearest(const Eigen::Vector3f& from,
                                            const Eigen::Vector3f& direction) const {
    RTCRayHit hit{};
    hit.ray = ray_of(from, direction);
    hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_.get(), &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

    return surface(hit, from, direction);
}

RaySurface RayScene::surface(const RTCRayHit& hit, const Eigen::Vector3f& from,
                             const Eigen::Vector3f& direction) const {
    const bool instance = hit.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    const Item& item = items_[instance ? hit.hit.instID[0] : hit.hit.geomID];
    RaySurface surface{hit.ray.tfar, from + hit.ray.tfar * direction, {}, {}, item.drawn};
    const Eigen::Vector3f flat(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z);
    surface.start = surface.point;
    if (item.surface) {
        const SmoothSurface::Look look =
            item.surface->look({hit.hit.primID, hit.hit.u, hit.hit.v}, direction);
        surface.normal = look.normal;
        surface.start = look.rounded;
    } else {
        surface.geometry = item.geometry;
        surface.point_local = item.rotation.transpose() * (surface.point - item.position);
        const Eigen::Vector3f normal =
            item.geometry ? true_normal(*item.geometry, surface.point_local, flat) : flat;
        surface.normal = (item.rotation * normal).normalized();
        if (surface.normal.dot(direction) > 0) surface.normal = -surface.normal;
    }
    surface.start += 2e-4f * surface.distance * surface.normal;
    return surface;
}

bool RayScene::blocked(const Eigen::Vector3f& from, const Eigen::Vector3f& direction) const {
    RTCRay ray = ray_of(from, direction);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene_.get(), &context, &ray);
    return ray.tfar < 0;
}

}  // namespace plumb
