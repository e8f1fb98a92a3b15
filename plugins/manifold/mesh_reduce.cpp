// SPDX-License-Identifier: MIT
#include "manifold/mesh_reduce.h"

namespace plumb {
namespace {

constexpr std::size_t kMostOfPlane = 8;

/// A contact among those of its plane.
struct Spot {
    double x, y;  ///< in the plane [m]
    std::uint32_t contact;
};

/// Twice the area to the left of the way from p over q to r [m²].
double turn(const Spot& p, const Spot& q, const Spot& r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

double distance(const Spot& p, const Spot& q) { return std::hypot(p.x - q.x, p.y - q.y); }

class PlaneReducer {
public:
    PlaneReducer(Contact* all, std::size_t count, bool surface_is_a, double bend)
        : all_(all), surface_is_a_(surface_is_a), bend_(bend) {
        kept_.assign(count, 0);
        done_.assign(count, 0);
    }

    /// Marks what stays of the plane of contact `first`.
    void reduce_plane_of(std::size_t first) {
        if (done_[first]) return;
        gather(first);
        outline();
        while (hull_.size() > kMostOfPlane) drop_least();
        for (const Spot& s : hull_) kept_[s.contact] = 1;
        kept_[deepest_] = 1;
    }
    bool keeps(std::size_t i) const { return kept_[i] != 0; }

private:
    Vec3 place(std::size_t i) const { return surface_is_a_ ? all_[i].point_a : all_[i].point_b; }

    /// All contacts with the plane of the first; `deepest_` only where it beats the others.
    void gather(std::size_t first) {
        const Vec3 n = all_[first].normal, p = place(first);
        const Vec3 u = any_perpendicular(n), w = cross(n, u);
        spots_.clear();
        deepest_ = first;
        const double least = 1 - 1e-10 - 0.5 * bend_ * bend_;
        for (std::size_t i = first; i < kept_.size(); ++i) {
            const Vec3 d = place(i) - p;
            const double off = (1e-6 + bend_) * norm(d) + 1e-9;
            if (done_[i] || dot(all_[i].normal, n) < least || std::abs(dot(d, n)) > off) continue;
            done_[i] = 1;
            spots_.push_back({dot(d, u), dot(d, w), static_cast<std::uint32_t>(i)});
        }
        for (const Spot& s : spots_) size_ = std::max(size_, distance(s, spots_[0]));
    }

    /// The convex outline, without corners that stand on a side of it: from a corner on, the next
    /// is always that which has nothing to its right.
    void outline() {
        hull_.clear();
        const Spot& first = spots_[0];
        Spot at = next_corner(*std::max_element(
            spots_.begin(), spots_.end(),
            [&](const Spot& p, const Spot& q) { return distance(first, p) < distance(first, q); }));
        do {
            hull_.push_back(at);
            at = next_corner(at);
        } while (distance(at, hull_[0]) > near() && hull_.size() < spots_.size());
        find_deepest();
    }

    /// The farthest of those on one side, and of those in one place the first.
    Spot next_corner(const Spot& p) const {
        Spot best = p;
        double reach = 0;
        for (const Spot& s : spots_) {
            const double d = distance(p, s), bend = turn(p, best, s);
            const double flat = near() * std::max(d, reach);
            const bool farther = bend <= flat && d > reach + near();
            if ((reach <= 0 && d > near()) || (d > near() && (bend < -flat || farther)))
                best = s, reach = d;
        }
        return best;
    }

    /// What lies within this is in one place [m].
    double near() const { return 1e-5 * size_ + 1e-9; }

    /// The deepest of the plane: a corner of the outline where that is as deep.
    void find_deepest() {
        const auto gap = [this](const Spot& s) { return all_[s.contact].gap; };
        const auto less = [&](const Spot& p, const Spot& q) { return gap(p) < gap(q); };
        const Spot& corner = *std::min_element(hull_.begin(), hull_.end(), less);
        const Spot& any = *std::min_element(spots_.begin(), spots_.end(), less);
        deepest_ = gap(any) < gap(corner) - 1e-9 ? any.contact : corner.contact;
    }

    void drop_least() {
        std::size_t least = 0;
        double least_area = 1e300;
        for (std::size_t i = 0; i < hull_.size(); ++i) {
            if (hull_[i].contact == deepest_) continue;
            const Spot &p = hull_[(i + hull_.size() - 1) % hull_.size()],
                       &r = hull_[(i + 1) % hull_.size()];
            const double area = std::abs(turn(p, hull_[i], r));
            if (area < least_area) least_area = area, least = i;
        }
        hull_.erase(hull_.begin() + static_cast<std::ptrdiff_t>(least));
    }

    Contact* all_;
    bool surface_is_a_;
    double bend_;      ///< [rad]
    double size_ = 0;  ///< of what was gathered [m]
    std::size_t deepest_ = 0;
    // Memory of the thread, so that a pair allocates nothing.
    static thread_local std::vector<std::uint8_t> kept_, done_;
    static thread_local std::vector<Spot> spots_, hull_;
};

thread_local std::vector<std::uint8_t> PlaneReducer::kept_, PlaneReducer::done_;
thread_local std::vector<Spot> PlaneReducer::spots_, PlaneReducer::hull_;

}  // namespace

void reduce_by_planes(ContactList& contacts, std::size_t begin, bool surface_is_a, double bend) {
    Contact* all = contacts.data() + begin;
    const std::size_t count = contacts.size() - begin;
    if (count < 2) return;
    PlaneReducer reducer(all, count, surface_is_a, bend);
    for (std::size_t i = 0; i < count; ++i) reducer.reduce_plane_of(i);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (reducer.keeps(i)) all[kept++] = all[i];
    contacts.shrink(begin + kept);
}

}  // namespace plumb
