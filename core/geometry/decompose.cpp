// SPDX-License-Identifier: MIT
#include "geometry/decompose.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "geometry/bad_shape.h"
#include "geometry/hull.h"
#include "geometry/solid.h"

namespace plumb {

namespace {

using Eigen::Vector3d;

constexpr int kPlacesAcross = 4;       // planes tried across each axis
constexpr double kSnap = 1e-9;         // corners so near to a plane lie in it [part of the size]
constexpr double kLeastShare = 1e-4;   // no part is smaller than this share of the whole
constexpr double kSpreadWeight = 0.3;  // of the parts' spread against their excess
constexpr double kVolumeError = 1e-6;  // by which two halves may miss the whole

/// A part with its hull.
struct Part {
    Solid solid;
    std::vector<Plane> cuts;  // that it was made by
    Hull hull;
    double volume, excess;  ///< of the solid; of the hull beyond it [m³]
};

double volume_of(const Hull& hull) {
    const Vector3d from = hull.vertices[0];
    double sixfold = 0;
    for (const auto& face : hull.faces)
        for (std::size_t i = 2; i < face.size(); ++i)
            sixfold +=
                (hull.vertices[face[0]] - from)
                    .dot((hull.vertices[face[i - 1]] - from).cross(hull.vertices[face[i]] - from));
    return sixfold / 6;
}

/// Corners that can be corners of the hull: those on the mesh's own surface, and those where two
/// cuts meet; the other corners of cut faces lie between these.
std::vector<Vector3d> outer_corners(const Solid& solid, const std::vector<Plane>& cuts,
                                    double tolerance) {
    Solid outer;
    for (const SolidFacet& facet : solid) {
        if (!facet.cut) outer.push_back(facet);
        if (!facet.cut || cuts.size() < 2) continue;
        for (const Vector3d& p : facet.corners) {
            const auto meets = [&](const Plane& c) {
                return std::abs(c.normal.dot(p) - c.offset) <= 2 * tolerance;
            };
            if (std::count_if(cuts.begin(), cuts.end(), meets) >= 2)
                outer.push_back({{p, p, p}, true});
        }
    }
    return corners_of(outer);
}

Part part_of(Solid solid, std::vector<Plane> cuts, double volume, double tolerance) {
    Hull hull = convex_hull(outer_corners(solid, cuts, tolerance));
    const double excess = std::max(0.0, volume_of(hull) - volume);
    return {std::move(solid), std::move(cuts), std::move(hull), volume, excess};
}

/// Number of each corner, the same for corners at the same place.
std::vector<std::size_t> places_of(const std::vector<Vector3d>& vertices) {
    const auto before = [](const Vector3d& a, const Vector3d& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    };
    std::map<Vector3d, std::size_t, decltype(before)> first(before);
    std::vector<std::size_t> places;
    for (const Vector3d& v : vertices)
        places.push_back(first.emplace(v, places.size()).first->second);
    return places;
}

/// Fails unless each edge runs once in each direction.
void require_closed(const Geometry& mesh) {
    const std::vector<std::size_t> place = places_of(mesh.vertices);
    std::map<std::pair<std::size_t, std::size_t>, int>
        edges;  // how often there less how often back
    for (const auto& t : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t a = place[t[i]], b = place[t[(i + 1) % 3]];
            if (a != b) edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    for (const auto& [edge, sum] : edges) {
        if (sum == 0) continue;
        throw BadShape(
            "the mesh is not closed, so it has no inside to decompose: its triangles do not meet "
            "in "
            "pairs, or turn different ways, along the edge from vertex " +
            std::to_string(edge.first) + " to " + std::to_string(edge.second));
    }
}

/// Planes of faces that meet at an inward edge of the mesh, each once.
std::vector<Plane> inward_planes(const Geometry& mesh, double tolerance) {
    const std::vector<std::size_t> place = places_of(mesh.vertices);
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> across;  // edge → triangle
    std::vector<Plane> plane_of;
    for (const auto& t : mesh.triangles) {
        const Vector3d& a = mesh.vertices[t[0]];
        const Vector3d n = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).normalized();
        for (std::size_t i = 0; i < 3; ++i)
            across[{place[t[i]], place[t[(i + 1) % 3]]}] = plane_of.size();
        plane_of.push_back({n, n.dot(a)});
    }
    std::vector<Plane> found;
    for (const auto& [edge, triangle] : across) {
        const auto other = across.find({edge.second, edge.first});
        if (other == across.end()) continue;
        // Inward if the neighbour's far corner stands out of this triangle's plane.
        const Plane& p = plane_of[triangle];
        double out = 0;
        for (const std::uint32_t i : mesh.triangles[other->second])
            out = std::max(out, p.normal.dot(mesh.vertices[i]) - p.offset);
        if (out < 1e3 * tolerance) continue;
        const bool known = std::any_of(found.begin(), found.end(), [&](const Plane& q) {
            return std::abs(q.normal.dot(p.normal)) > 1 - 1e-9 &&
                   std::abs(q.offset * q.normal.dot(p.normal) - p.offset) < 1e3 * tolerance;
        });
        if (!known) found.push_back(p);
    }
    // Where there are many, the surface is round, and the planes across the axes do as well.
    constexpr std::size_t kMost = 24;
    if (found.size() > kMost) found.clear();
    return found;
}

/// Planes across an axis: through corners at even ranks, and in the middle.
void add_planes_across(std::vector<Plane>& planes, const Vector3d& axis,
                       const std::vector<Vector3d>& points, double tolerance) {
    std::vector<double> places;
    for (const Vector3d& p : points) places.push_back(axis.dot(p));
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end(),
                             [&](double a, double b) { return b - a <= 1e3 * tolerance; }),
                 places.end());
    if (places.size() < 2) return;
    planes.push_back({axis, (places.front() + places.back()) / 2});
    const std::size_t between = places.size() - 2;
    const std::size_t count = std::min<std::size_t>(between, kPlacesAcross);
    for (std::size_t i = 0; i < count; ++i)
        planes.push_back({axis, places[1 + (2 * i + 1) * between / (2 * count)]});
}

/// Principal axes of points.
Eigen::Matrix3d principal_axes(const std::vector<Vector3d>& points) {
    Vector3d mean = Vector3d::Zero();
    for (const Vector3d& p : points) mean += p / static_cast<double>(points.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vector3d& p : points) spread += (p - mean) * (p - mean).transpose();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
}

class Decomposition {
public:
    explicit Decomposition(const Geometry& mesh) {
        Eigen::AlignedBox3d bounds;
        for (const Vector3d& v : mesh.vertices) bounds.extend(v);
        tolerance_ = kSnap * bounds.diagonal().norm();
        Solid solid;
        for (const auto& t : mesh.triangles)
            solid.push_back(
                {{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, false});
        volume_ = plumb::volume_of(solid, bounds.center());
        if (!(volume_ > 0)) {
            throw BadShape(
                "the mesh has no volume, or is inside out: its triangles must be counter-clockwise "
                "seen from outside");
        }
        square_radius_ = spread_of(solid, bounds.center()) / volume_;
        inward_ = inward_planes(mesh, tolerance_);
        parts_.push_back(part_of(std::move(solid), {}, volume_, tolerance_));
    }

    void refine(const DecomposeOptions& options) {
        while (excess() > options.excess * volume_ && parts_.size() < options.max_parts) {
            const auto worst =
                std::max_element(parts_.begin(), parts_.end(),
                                 [](const Part& a, const Part& b) { return a.excess < b.excess; });
            std::optional<Plane> plane = best_plane(*worst);
            if (!plane) break;
            OpenHalves halves = cut_open(worst->solid, *plane, tolerance_);
            close_at(halves.below, *plane, 1, tolerance_);
            close_at(halves.above, *plane, -1, tolerance_);
            const Vector3d from = plane->offset * plane->normal;
            const double below = plumb::volume_of(halves.below, from);
            const double above = plumb::volume_of(halves.above, from);
            std::vector<Plane> cuts = worst->cuts;
            cuts.push_back(*plane);
            *worst = part_of(std::move(halves.below), cuts, below, tolerance_);
            parts_.push_back(part_of(std::move(halves.above), cuts, above, tolerance_));
        }
    }

    const std::vector<Part>& parts() const { return parts_; }

    /// Deepest that a corner or middle of the mesh's surface lies within the hull of its part [m].
    double concavity() const {
        double deepest = 0;
        for (const Part& part : parts_)
            for (const auto& [c, cut] : part.solid) {
                if (cut) continue;
                for (const Vector3d& p : {c[0], c[1], c[2], Vector3d((c[0] + c[1] + c[2]) / 3)})
                    deepest = std::max(deepest, depth_in(part.hull, p));
            }
        return deepest;
    }

private:
    double excess() const {
        double sum = 0;
        for (const Part& part : parts_) sum += part.excess;
        return sum;
    }

    static double depth_in(const Hull& hull, const Vector3d& p) {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& face : hull.faces) {
            Vector3d normal = Vector3d::Zero();  // twice the face's area
            const Vector3d& a = hull.vertices[face[0]];
            for (std::size_t i = 2; i < face.size(); ++i)
                normal += (hull.vertices[face[i - 1]] - a).cross(hull.vertices[face[i]] - a);
            least = std::min(least, normal.normalized().dot(a - p));
        }
        return least;
    }

    /// What is bad about a cut: the excess that it leaves, and a little for parts that spread
    /// far, since the halves of a ring exceed as much as the ring. Nothing where it cuts too little
    /// off.
    std::optional<double> badness(const Part& part, const Plane& plane) const {
        const OpenHalves halves = cut_open(part.solid, plane, tolerance_);
        if (halves.below.empty() || halves.above.empty()) return {};
        const Vector3d from = plane.offset * plane.normal;
        const double below = plumb::volume_of(halves.below, from);
        const double above = plumb::volume_of(halves.above, from);
        if (std::min(below, above) < kLeastShare * volume_) return {};
        if (std::abs(below + above - part.volume) > kVolumeError * volume_) return {};
        try {
            std::vector<Plane> cuts = part.cuts;
            cuts.push_back(plane);
            const auto share = [&](const Solid& half, double volume) {
                const Hull hull = convex_hull(outer_corners(half, cuts, tolerance_));
                return volume_of(hull) - volume +
                       kSpreadWeight * spread_of(half, from) / square_radius_;
            };
            return share(halves.below, below) + share(halves.above, above);
        } catch (const BadShape&) {
            return {};
        }
    }

    std::optional<Plane> best_plane(const Part& part) const {
        const std::vector<Vector3d> points = corners_of(part.solid);
        const Eigen::Matrix3d axes = principal_axes(points);
        std::vector<Plane> planes = inward_;
        for (int i = 0; i < 3; ++i) {
            add_planes_across(planes, axes.col(i), points, tolerance_);
            add_planes_across(planes, Vector3d::Unit(i), points, tolerance_);
        }
        std::optional<Plane> best;
        double least = std::numeric_limits<double>::infinity();
        for (const Plane& plane : planes) {
            const std::optional<double> bad = badness(part, plane);
            if (!bad || *bad >= least * (1 - 1e-9)) continue;
            least = *bad;
            best = plane;
        }
        return best;
    }

    double tolerance_, volume_;  // [m], [m³]
    double square_radius_;       // mean squared distance from the centre [m²]
    std::vector<Plane> inward_;
    std::vector<Part> parts_;
};

}  // namespace

Geometry decomposed(const Geometry& mesh, const DecomposeOptions& options) {
    require_closed(mesh);
    Decomposition decomposition(mesh);
    decomposition.refine(options);
    Geometry compound;
    compound.kind = ShapeKind::compound;
    compound.concavity = decomposition.concavity();
    for (const Part& part : decomposition.parts()) {
        GeometryPart& hull = compound.parts.emplace_back();
        hull.geometry.kind = ShapeKind::hull;
        hull.geometry.vertices = part.hull.vertices;
        hull.geometry.faces = part.hull.faces;
    }
    return compound;
}

}  // namespace plumb
