// SPDX-License-Identifier: MIT
#include "ode/broad.h"

namespace plumb::ode {
namespace {

struct StandIn {
    const Part* part;
    std::uint32_t index;
};

StandIn& stand_in(dGeomID geom) { return *static_cast<StandIn*>(dGeomGetClassData(geom)); }

void bounds(dGeomID geom, dReal box[6]) {
    const Aabb& b = stand_in(geom).part->bounds;
    for (int k = 0; k < 3; ++k) {
        box[2 * k] = std::max(-dInfinity, at(b.low, k));
        box[2 * k + 1] = std::min(dInfinity, at(b.high, k));
    }
}

dColliderFn* no_collider(int) { return nullptr; }

/// ODE has room for a handful of classes in a process, so ours is made once.
int stand_in_class() {
    static const int made = [] {
        dGeomClass c{};
        c.bytes = sizeof(StandIn);
        c.collider = no_collider;
        c.aabb = bounds;
        return dCreateGeomClass(&c);
    }();
    return made;
}

struct Query {
    std::vector<PartPair>& pairs;
    const BodyTable& table;
};

void meet(void* data, dGeomID p, dGeomID q) {
    Query& query = *static_cast<Query*>(data);
    const StandIn &a = stand_in(p), &b = stand_in(q);
    if (query.table.wanted(*a.part, *b.part))
        query.pairs.push_back({std::min(a.index, b.index), std::max(a.index, b.index)});
}

constexpr unsigned long kStill = 1, kDynamic = 2;

}  // namespace

HashSpace::HashSpace() : space_(dHashSpaceCreate(nullptr)) { dSpaceSetCleanup(space_, 1); }
HashSpace::~HashSpace() { dSpaceDestroy(space_); }

void HashSpace::refill(const BodyTable& table) {
    for (dGeomID geom : stand_ins_) dGeomDestroy(geom);
    stand_ins_.clear();
    const std::vector<Part>& parts = table.parts();
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        dGeomID geom = dCreateGeom(stand_in_class());
        stand_in(geom) = {&parts[i], i};
        dGeomSetCategoryBits(geom, parts[i].dynamic ? kDynamic : kStill);
        dGeomSetCollideBits(geom, parts[i].dynamic ? kDynamic | kStill : kDynamic);
        dSpaceAdd(space_, geom);
        stand_ins_.push_back(geom);
    }
    version_ = table.version();
}

void HashSpace::choose_levels(const BodyTable& table) {
    // Cells from the size of the smallest part to that of the largest bounded one; what is larger
    // meets everybody.
    double least = 1e300, most = 0;
    for (const Part& p : table.parts()) {
        const Vec3 d = p.bounds.high - p.bounds.low;
        const double size = std::max({d.x, d.y, d.z});
        if (!p.present || !p.dynamic || !std::isfinite(size)) continue;
        least = std::min(least, size);
        most = std::max(most, size);
    }
    if (most <= 0) return;
    const int high = static_cast<int>(std::ceil(std::log2(most)));
    const int low = std::max(high - 8, static_cast<int>(std::ceil(std::log2(least))));
    dHashSpaceSetLevels(space_, low, high);
}

void HashSpace::find_pairs(std::vector<PartPair>& pairs, const BodyTable& table) {
    if (version_ != table.version()) refill(table);
    choose_levels(table);
    const std::vector<Part>& parts = table.parts();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!parts[i].present) {
            dGeomDisable(stand_ins_[i]);
            continue;
        }
        dGeomEnable(stand_ins_[i]);
        const Vec3 p = parts[i].world.origin;  // only tells ODE that the bounds have changed
        dGeomSetPosition(stand_ins_[i], p.x, p.y, p.z);
    }
    Query query{pairs, table};
    dSpaceCollide(space_, &query, meet);
}

}  // namespace plumb::ode
