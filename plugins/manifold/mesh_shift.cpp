// SPDX-License-Identifier: MIT
#include "manifold/mesh_shift.h"

namespace plumb {
namespace {

constexpr std::size_t kMostShifts = 32;

/// Moves a out of b along one normal.
struct Shift {
    Vec3 normal;
    double length;  ///< that parts all contacts along it [m]
};

/// One for each normal along which something touches, the shortest first.
void collect(std::vector<Shift>& shifts, const Contact* all, std::size_t count, double slack) {
    shifts.clear();
    for (const Contact* c = all; c < all + count; ++c) {
        if (c->gap > slack) continue;
        const double depth = std::max(0.0, -c->gap);
        const auto same = [&](const Shift& s) { return dot(s.normal, c->normal) > 1 - 1e-9; };
        const auto it = std::find_if(shifts.begin(), shifts.end(), same);
        if (it == shifts.end())
            shifts.push_back({c->normal, depth});
        else
            it->length = std::max(it->length, depth);
    }
    std::stable_sort(shifts.begin(), shifts.end(),
                     [](const Shift& p, const Shift& q) { return p.length < q.length; });
    if (shifts.size() > kMostShifts) shifts.resize(kMostShifts);
}

}  // namespace

void keep_shortest_ways(ContactList& contacts, std::size_t begin, const MeshSide& a,
                        const MeshSide& b) {
    static thread_local std::vector<Shift> shifts;  // so that a pair allocates nothing
    Contact* all = contacts.data() + begin;
    const std::size_t count = contacts.size() - begin;
    const double slack = a.slack() + b.slack();
    collect(shifts, all, count, slack);
    const auto parted = [&](const Contact& c) {
        for (const Shift& s : shifts) {
            if (s.length >= -c.gap - 10 * slack) return false;
            const Vec3 way = s.length * s.normal;
            const bool inside =
                c.reserved == kBodyIsB ? a.holds(c.point_b - way) : b.holds(c.point_a + way);
            if (!inside) return true;
        }
        return false;
    };
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (!parted(all[i])) all[kept++] = all[i];
    contacts.shrink(begin + kept);
}

}  // namespace plumb
