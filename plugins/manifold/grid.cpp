// SPDX-License-Identifier: MIT
/// A part is entered in every cell that it covers. Two parts meet in the one cell that holds the
/// higher of their low corners, on every axis: so no pair is found twice. Cells are hashed into
/// buckets; a bucket may hold several cells.
#include "manifold/grid.h"

namespace plumb {
namespace {

constexpr int kMostCells = 64;  ///< a part that covers more is tested against all

std::uint32_t bucket_of(const std::int32_t* cell, std::uint32_t mask) {
    const auto x = static_cast<std::uint32_t>(cell[0]) * 0x8da6b343u;
    const auto y = static_cast<std::uint32_t>(cell[1]) * 0xd8163841u;
    const auto z = static_cast<std::uint32_t>(cell[2]) * 0xcb1ab31fu;
    const std::uint32_t h = x ^ y ^ z;
    return (h ^ (h >> 15)) & mask;
}

constexpr std::uint32_t kOnEveryAxis = 7;

}  // namespace

/// Along each axis a cell that both cover is the higher of their low ones where it is the low one
/// of either.
bool Grid::meet_here(const Entry& p, const Entry& q) {
    return (p.is_low | q.is_low) == kOnEveryAxis && p.cell[0] == q.cell[0] &&
           p.cell[1] == q.cell[1] && p.cell[2] == q.cell[2];
}

void Grid::enter(std::uint32_t part, const Range& r) {
    for (std::int32_t x = r.low[0]; x <= r.high[0]; ++x)
        for (std::int32_t y = r.low[1]; y <= r.high[1]; ++y)
            for (std::int32_t z = r.low[2]; z <= r.high[2]; ++z) {
                const std::uint32_t is_low =
                    (x == r.low[0]) | (y == r.low[1]) << 1 | (z == r.low[2]) << 2;
                loose_.push_back({{x, y, z}, part, is_low});
            }
}

double Grid::cell_size(const BodyTable& table) {
    // Half as large again as the middle one of the parts, so that most cover few cells.
    sizes_.clear();
    for (const Part& part : table.parts()) {
        const Vec3 d = part.fat.high - part.fat.low;
        const double size = std::max({d.x, d.y, d.z});
        if (part.present && std::isfinite(size)) sizes_.push_back(size);
    }
    if (sizes_.empty()) return 1;
    const auto middle = sizes_.begin() + static_cast<std::ptrdiff_t>(sizes_.size() / 2);
    std::nth_element(sizes_.begin(), middle, sizes_.end());
    return std::max(1.5 * *middle, 1e-9);
}

void Grid::sort_into_cells(const BodyTable& table, double size) {
    const std::vector<Part>& parts = table.parts();
    is_large_.assign(parts.size(), 0);
    large_.clear();
    loose_.clear();
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        if (!parts[i].present) continue;
        Range r;
        double cells = 1;
        for (int k = 0; k < 3; ++k) {
            const double low = std::floor(at(parts[i].fat.low, k) / size);
            const double high = std::floor(at(parts[i].fat.high, k) / size);
            const bool fits = std::abs(low) < 1e9 && std::abs(high) < 1e9;
            cells = fits ? cells * (high - low + 1) : 1e30;
            r.low[k] = fits ? static_cast<std::int32_t>(low) : 0;
            r.high[k] = fits ? static_cast<std::int32_t>(high) : 0;
        }
        if (!(cells <= kMostCells)) {
            large_.push_back(i);
            is_large_[i] = 1;
            continue;
        }
        enter(i, r);
    }

    // A counting sort by bucket.
    std::uint32_t buckets = 64;
    while (buckets < loose_.size()) buckets *= 2;
    bucket_.assign(buckets + 1, 0);
    for (const Entry& e : loose_) ++bucket_[bucket_of(e.cell, buckets - 1)];
    std::uint32_t sum = 0;
    for (std::uint32_t& b : bucket_) sum += b, b = sum;
    sorted_.resize(loose_.size());
    for (const Entry& e : loose_) sorted_[--bucket_[bucket_of(e.cell, buckets - 1)]] = e;
}

void Grid::meet_in_cell(std::vector<PartPair>& pairs, const BodyTable& table, std::uint32_t begin,
                        std::uint32_t end) {
    const std::vector<Part>& parts = table.parts();
    for (std::uint32_t i = begin; i < end; ++i)
        for (std::uint32_t j = i + 1; j < end; ++j) {
            const Entry &p = sorted_[i], &q = sorted_[j];
            if (!meet_here(p, q)) continue;
            const Part &a = parts[p.part], &b = parts[q.part];
            if (overlap(a.fat, b.fat) && table.wanted(a, b))
                pairs.push_back({std::min(p.part, q.part), std::max(p.part, q.part)});
        }
}

void Grid::find_pairs(std::vector<PartPair>& pairs, const BodyTable& table) {
    sort_into_cells(table, cell_size(table));
    for (std::size_t b = 0; b + 1 < bucket_.size(); ++b)
        if (bucket_[b + 1] > bucket_[b] + 1) meet_in_cell(pairs, table, bucket_[b], bucket_[b + 1]);

    // The large ones against all, and each two of them once.
    const std::vector<Part>& parts = table.parts();
    for (std::uint32_t i : large_)
        for (std::uint32_t j = 0; j < parts.size(); ++j) {
            if (!parts[j].present || j == i || (is_large_[j] && j < i)) continue;
            if (overlap(parts[i].fat, parts[j].fat) && table.wanted(parts[i], parts[j]))
                pairs.push_back({std::min(i, j), std::max(i, j)});
        }
}

}  // namespace plumb
