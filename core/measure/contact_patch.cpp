// SPDX-License-Identifier: MIT
#include "measure/contact_patch.h"

#include "world/contacts.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace plumb {
namespace {

constexpr double kSameNormal = 0.99939;  // cos 2°

using Point = Eigen::Vector2d;

double turn(const Point& o, const Point& p, const Point& q) {
    return (p.x() - o.x()) * (q.y() - o.y()) - (p.y() - o.y()) * (q.x() - o.x());
}

/// One half of the outline, from the leftmost point to the rightmost (monotone chain).
void add_chain(std::vector<Point>& outline, const std::vector<Point>& sorted) {
    const std::size_t begin = outline.size();
    for (const Point& p : sorted) {
        while (outline.size() >= begin + 2 &&
               turn(outline[outline.size() - 2], outline.back(), p) <= 0)
            outline.pop_back();
        outline.push_back(p);
    }
    outline.pop_back();
}

/// Area of the convex outline of some points [m²]; reorders them.
double outlined_area(std::vector<Point>& points) {
    if (points.size() < 3) return 0;
    std::sort(points.begin(), points.end(), [](const Point& p, const Point& q) {
        return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
    });
    std::vector<Point> outline;
    add_chain(outline, points);
    std::reverse(points.begin(), points.end());
    add_chain(outline, points);
    double twice = 0;
    for (std::size_t i = 2; i < outline.size(); ++i)
        twice += turn(outline[0], outline[i - 1], outline[i]);
    return 0.5 * std::abs(twice);
}

double greatest_distance(const std::vector<Point>& points) {
    double square = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            square = std::max(square, (points[i] - points[j]).squaredNorm());
    return std::sqrt(square);
}

double support_of(PairContacts contacts, const Vector3d& d) {
    double reach = -HUGE_VAL;
    for (const Contact& c : contacts) reach = std::max(reach, common_point(c).dot(d));
    return reach;
}

}  // namespace

const Contact& deepest(PairContacts contacts) {
    return *std::min_element(contacts.begin(), contacts.end(),
                             [](const Contact& p, const Contact& q) { return p.gap < q.gap; });
}

Vector3d mean_normal(PairContacts contacts) {
    const Contact& deep = deepest(contacts);
    Vector3d sum = Vector3d::Zero();
    for (const Contact& c : contacts)
        sum += (deep.gap < 0 ? std::max(0.0, -c.gap) : 1.0) * to_eigen(c.normal);
    return sum.norm() > 0 ? Vector3d(sum.normalized()) : to_eigen(deep.normal);
}

PatchExtent patch_extent(PairContacts contacts, double highest) {
    const Vector3d n = to_eigen(deepest(contacts).normal);
    const Vector3d across = n.unitOrthogonal(), along = n.cross(across);
    std::vector<Point> points;
    for (const Contact& c : contacts) {
        if (!(c.gap <= highest) || to_eigen(c.normal).dot(n) < kSameNormal) continue;
        const Vector3d p = common_point(c);
        points.push_back({p.dot(across), p.dot(along)});
    }
    const double span = greatest_distance(points);
    return {outlined_area(points), span};
}

double footprint_distance(PairContacts first, PairContacts second) {
    double distance = 0;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                if (x == 0 && y == 0 && z == 0) continue;
                const Vector3d d = Vector3d(x, y, z).normalized();
                const double apart = support_of(first, d) - support_of(second, d);
                distance = std::max(distance, std::abs(apart));
            }
    return distance;
}

}  // namespace plumb
