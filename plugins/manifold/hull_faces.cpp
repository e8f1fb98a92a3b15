// SPDX-License-Identifier: MIT
#include "manifold/hull_faces.h"

namespace plumb {
namespace {

/// Newell's normal: right for any planar polygon, also where its first corners lie on a line.
Vec3 polygon_normal(const Shape& hull, const std::vector<std::uint32_t>& corners) {
    Vec3 sum{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3& p = hull.vertices[corners[i]];
        const Vec3& q = hull.vertices[corners[(i + 1) % corners.size()]];
        sum = sum + cross(p, q);
    }
    return unit_or(sum, {0, 0, 0});
}

/// Puts the corners in order around their centre, counter-clockwise about the normal.
void order_corners(HullFace& face, const Shape& hull) {
    Vec3 centre{};
    for (auto i : face.corners) centre = centre + hull.vertices[i];
    centre = (1.0 / static_cast<double>(face.corners.size())) * centre;
    const Vec3 u = any_perpendicular(face.normal), v = cross(face.normal, u);
    const auto angle = [&](std::uint32_t i) {
        const Vec3 d = hull.vertices[i] - centre;
        return std::atan2(dot(d, v), dot(d, u));
    };
    std::sort(face.corners.begin(), face.corners.end(),
              [&](auto i, auto j) { return angle(i) < angle(j); });
}

/// Drops corners that lie on the line between their neighbours.
void drop_straight_corners(HullFace& face, const Shape& hull) {
    for (std::size_t i = 0; i < face.corners.size() && face.corners.size() > 3;) {
        const std::size_t n = face.corners.size();
        const Vec3& p = hull.vertices[face.corners[(i + n - 1) % n]];
        const Vec3& q = hull.vertices[face.corners[i]];
        const Vec3& r = hull.vertices[face.corners[(i + 1) % n]];
        const double area = norm(cross(q - p, r - q));
        if (area < 1e-9 * norm(q - p) * norm(r - q) + 1e-18)
            face.corners.erase(face.corners.begin() + static_cast<std::ptrdiff_t>(i));
        else
            ++i;
    }
}

HullFace* same_plane(std::vector<HullFace>& faces, const HullFace& face, const Shape& hull,
                     double size) {
    for (HullFace& other : faces) {
        if (dot(other.normal, face.normal) < 1 - 1e-9) continue;
        const Vec3 offset = hull.vertices[face.corners[0]] - hull.vertices[other.corners[0]];
        if (std::abs(dot(offset, other.normal)) < 1e-6 * size) return &other;
    }
    return nullptr;
}

double size_of(const Shape& hull) {
    double size = 0;
    for (std::uint32_t i = 0; i < hull.vertex_count; ++i)
        size = std::max(size, norm(hull.vertices[i] - hull.vertices[0]));
    return size;
}

}  // namespace

std::vector<HullFace> merged_faces(const Shape& hull) {
    std::vector<HullFace> faces;
    const double size = size_of(hull);
    const std::uint32_t* at_face = hull.faces;
    for (std::uint32_t f = 0; f < hull.face_count; ++f) {
        const std::uint32_t corners = *at_face++;
        HullFace face;
        face.corners.assign(at_face, at_face + corners);
        at_face += corners;
        face.normal = polygon_normal(hull, face.corners);
        if (dot(face.normal, face.normal) < 0.5) continue;  // a sliver without area

        // Join a face that lies in the plane of an earlier one.
        if (HullFace* first = same_plane(faces, face, hull, size)) {
            for (auto i : face.corners)
                if (std::find(first->corners.begin(), first->corners.end(), i) ==
                    first->corners.end())
                    first->corners.push_back(i);
        } else {
            faces.push_back(std::move(face));
        }
    }
    for (HullFace& face : faces) {
        order_corners(face, hull);
        drop_straight_corners(face, hull);
    }
    return faces;
}

}  // namespace plumb
