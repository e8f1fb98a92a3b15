// SPDX-License-Identifier: MIT
#include "geometry/hull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>

#include "geometry/bad_shape.h"

extern "C" {
#include <libqhull_r/libqhull_r.h>
}

namespace plumb {

namespace {

using Eigen::Vector3d;
using Faces = std::vector<std::vector<std::uint32_t>>;

constexpr double kThinnest = 1e-9;  // least volume of a hull whose points span a box of diagonal 1

/// qhull's state, freed on every way out.
class Qhull {
public:
    Qhull() : messages_(std::tmpfile()) {
        if (!messages_) throw BadShape("qhull has no room for its messages");
        qh_zero(&state_, messages_);
    }
    ~Qhull() {
        qh_freeqhull(&state_, !qh_ALL);
        int blocks = 0, bytes = 0;
        qh_memfreeshort(&state_, &blocks, &bytes);
        std::fclose(messages_);
    }
    Qhull(const Qhull&) = delete;
    Qhull& operator=(const Qhull&) = delete;

    /// Runs qhull and returns its exit code. `coordinates` [3 × count] must outlive this object.
    int run(std::vector<double>& coordinates, std::string options) {
        return qh_new_qhull(&state_, 3, static_cast<int>(coordinates.size() / 3),
                            coordinates.data(), False, options.data(), nullptr, messages_);
    }

    facetT* first_facet() const { return state_.facet_list; }
    std::uint32_t point_index(const vertexT* vertex) {
        return static_cast<std::uint32_t>(qh_pointid(&state_, vertex->point));
    }

private:
    std::FILE* messages_;
    qhT state_{};
};

/// Coordinates about the middle of the points' box, whose diagonal becomes 1: so tolerances have no
/// unit.
std::vector<double> normalized(const std::vector<Vector3d>& points) {
    Vector3d low = points.front(), high = points.front();
    for (const Vector3d& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double diagonal = (high - low).norm();
    if (!(diagonal > 0)) throw BadShape("all points of the hull are the same point");

    std::vector<double> coordinates;
    coordinates.reserve(points.size() * 3);
    for (const Vector3d& p : points) {
        const Vector3d q = (p - (low + high) / 2) / diagonal;
        coordinates.insert(coordinates.end(), {q.x(), q.y(), q.z()});
    }
    return coordinates;
}

Vector3d point_at(const std::vector<double>& coordinates, std::uint32_t index) {
    return Eigen::Map<const Vector3d>(coordinates.data() + 3 * index);
}

void refuse(int exit_code) {
    if (exit_code == qh_ERRnone) return;
    if (exit_code == qh_ERRsingular) {
        throw BadShape(
            "the hull is flat: its points lie in one plane or on one line, within rounding");
    }
    if (exit_code == qh_ERRinput) throw BadShape("qhull cannot use the points of the hull");
    throw BadShape(
        "qhull gave up on the hull for lack of precision; give fewer points, or points further "
        "apart");
}

/// Sorts a facet's corners by angle about its normal: counter-clockwise seen from outside.
void sort_around(std::vector<std::uint32_t>& corners, const Vector3d& normal,
                 const std::vector<double>& coordinates) {
    Vector3d centre = Vector3d::Zero();
    for (const std::uint32_t i : corners) centre += point_at(coordinates, i);
    centre /= static_cast<double>(corners.size());

    const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
    const auto angle = [&](std::uint32_t i) {
        const Vector3d arm = point_at(coordinates, i) - centre;
        return std::atan2(v.dot(arm), u.dot(arm));
    };
    std::sort(corners.begin(), corners.end(),
              [&](std::uint32_t i, std::uint32_t j) { return angle(i) < angle(j); });
}

Faces faces_of(Qhull& qhull, const std::vector<double>& coordinates) {
    Faces faces;
    // The list ends with a facet that has no successor and is none.
    for (const facetT* facet = qhull.first_facet(); facet && facet->next; facet = facet->next) {
        std::vector<std::uint32_t> corners;
        vertexT *vertex, **vertexp;
        FOREACHvertex_(facet->vertices) { corners.push_back(qhull.point_index(vertex)); }
        sort_around(corners, Eigen::Map<const Vector3d>(facet->normal), coordinates);
        faces.push_back(std::move(corners));
    }
    return faces;
}

/// Whether each edge stands once in each direction, so that the faces close up.
bool closed(const Faces& faces) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& face : faces) {
        for (std::size_t i = 0; i < face.size(); ++i) {
            if (!edges.emplace(face[i], face[(i + 1) % face.size()]).second) return false;
        }
    }
    return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
        return edges.contains({edge.second, edge.first});
    });
}

double volume(const Faces& faces, const std::vector<double>& coordinates) {
    double sixfold = 0;
    for (const auto& face : faces) {
        const Vector3d a = point_at(coordinates, face[0]);
        for (std::size_t i = 2; i < face.size(); ++i) {
            sixfold +=
                a.dot(point_at(coordinates, face[i - 1]).cross(point_at(coordinates, face[i])));
        }
    }
    return sixfold / 6;
}

/// The hull over its own corners alone.
Hull compact(const Faces& faces, const std::vector<Vector3d>& points) {
    Hull hull;
    std::vector<std::uint32_t> corner(points.size(), UINT32_MAX);
    for (const auto& face : faces) {
        auto& indices = hull.faces.emplace_back();
        for (const std::uint32_t i : face) {
            if (corner[i] == UINT32_MAX) {
                corner[i] = static_cast<std::uint32_t>(hull.vertices.size());
                hull.vertices.push_back(points[i]);
            }
            indices.push_back(corner[i]);
        }
    }
    return hull;
}

/// Exit code of qhull, and the faces if it is qh_ERRnone.
struct Outcome {
    int exit_code;
    Faces faces;
};

/// Everything but bad input and flat points counts as a lack of precision.
Outcome try_hull(std::vector<double>& coordinates, const std::string& options) {
    Qhull qhull;
    const int code = qhull.run(coordinates, options);
    if (code == qh_ERRinput || code == qh_ERRsingular) return {code, {}};
    if (code != qh_ERRnone) return {qh_ERRprec, {}};
    Faces faces = faces_of(qhull, coordinates);
    return {closed(faces) ? qh_ERRnone : qh_ERRprec, std::move(faces)};
}

}  // namespace

Hull convex_hull(const std::vector<Vector3d>& points) {
    if (points.size() < 4) {
        throw BadShape("a hull needs at least 4 points, but there are " +
                       std::to_string(points.size()));
    }
    std::vector<double> coordinates = normalized(points);

    // Facets that lie in one plane within 1e-6 are merged; of very thin hulls only those that must
    // be.
    Outcome outcome = try_hull(coordinates, "qhull C-1e-6");
    if (outcome.exit_code == qh_ERRprec) outcome = try_hull(coordinates, "qhull");
    refuse(outcome.exit_code);
    if (volume(outcome.faces, coordinates) < kThinnest) refuse(qh_ERRsingular);
    return compact(outcome.faces, points);
}

}  // namespace plumb
