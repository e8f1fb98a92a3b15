// SPDX-License-Identifier: MIT
#include "reference/sweep.h"

namespace plumb::reference {
namespace {

struct Entry {
    double low, high;      ///< along the sweep's axis [m]
    double low_u, high_u;  ///< along the next one
    double low_v, high_v;  ///< along the last one
    std::uint32_t part;
};

/// The axis along which the parts are spread most; bounds that are infinite do not count.
int widest_axis(const std::vector<Part>& parts) {
    double best = -1;
    int axis = 0;
    for (int k = 0; k < 3; ++k) {
        double count = 0, sum = 0, squares = 0;
        for (const Part& p : parts) {
            const double x = 0.5 * (at(p.fat.low, k) + at(p.fat.high, k));
            if (!p.present || !std::isfinite(x)) continue;
            count += 1, sum += x, squares += x * x;
        }
        const double spread = count > 0 ? squares / count - (sum / count) * (sum / count) : 0;
        if (spread > best) best = spread, axis = k;
    }
    return axis;
}

std::vector<Entry> entries_along(int axis, const std::vector<Part>& parts) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::vector<Entry> entries;
    entries.reserve(parts.size());
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        const Aabb& b = parts[i].fat;
        if (parts[i].present)
            entries.push_back({at(b.low, axis), at(b.high, axis), at(b.low, u), at(b.high, u),
                               at(b.low, v), at(b.high, v), i});
    }
    return entries;
}

}  // namespace

void find_pairs(std::vector<PartPair>& pairs, const BodyTable& table) {
    const std::vector<Part>& parts = table.parts();
    std::vector<Entry> entries = entries_along(widest_axis(parts), parts);
    std::sort(entries.begin(), entries.end(), [](const Entry& p, const Entry& q) {
        return p.low < q.low || (p.low == q.low && p.part < q.part);
    });

    // Each entry meets those that begin before it ends.
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Entry& p = entries[i];
        for (std::size_t j = i + 1; j < entries.size() && entries[j].low <= p.high; ++j) {
            const Entry& q = entries[j];
            if (q.low_u > p.high_u || p.low_u > q.high_u || q.low_v > p.high_v ||
                p.low_v > q.high_v)
                continue;
            if (table.wanted(parts[p.part], parts[q.part]))
                pairs.push_back({std::min(p.part, q.part), std::max(p.part, q.part)});
        }
    }
}

}  // namespace plumb::reference
