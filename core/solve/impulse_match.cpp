// SPDX-License-Identifier: MIT
#include "solve/impulse_match.h"

#include "math/matrices.h"

#include <cmath>

namespace plumb {
namespace {

/// This share of the mean diagonal is added to the diagonal, so that what no impulse can change is
/// left as it is.
constexpr double kBeyondReach = 1e-7;
constexpr int kMatches = 3;

using Matched = std::vector<ElasticContacts::Body>;
using Side = ElasticContacts::Side;

/// What else is tied are particles, which the elements hold.
bool is_body(const Matched& bodies, const RowSide& side) { return side.body < bodies.size(); }

/// How the point of a side moves with its body's velocities, of which the angular one is times
/// `size`.
Eigen::Matrix<double, 3, 6> motion_of(const Matched& bodies, const Side& side) {
    Eigen::Matrix<double, 3, 6> m;
    m << Matrix3d::Identity(), -skew(side.arm) / bodies[side.body].size;
    return m;
}

/// What an impulse of 1 on a row does to a body, in the same measure; of turning over the row's
/// length.
Vector6d motion_of(const Matched& bodies, const TieRow& row, const RowSide& side) {
    Vector6d on = side.on / row.length;
    on.tail<3>() /= bodies[side.body].size;
    return on;
}

}  // namespace

void ImpulseMatch::load(const ElasticContacts& contacts, const ElasticTies& ties) {
    std::swap(touching_, touching_before_);
    touching_.clear();
    for (auto* pairs : {&touching_, &touching_before_})
        pairs->reserve(contacts.contacts().capacity());
    for (const ElasticContacts::Contact& c : contacts.contacts())
        if (c.sides[0].body != kNoIndex && c.sides[1].body != kNoIndex) {
            const std::pair now(c.sides[0].body, c.sides[1].body);
            if (touching_.empty() || touching_.back() != now) touching_.push_back(now);
        }
    ties.add_pairs(touching_);
    const Matched& bodies = contacts.bodies();
    missing_.reserve(bodies.capacity());
    missing_.resize(bodies.size());
    reach_.reserve(static_cast<std::uint32_t>(bodies.capacity()));
    if (reach_.rows() != bodies.size() || touching_ != touching_before_)
        reach_.analyse(static_cast<std::uint32_t>(bodies.size()), touching_);
}

/// Gᵀ G, where G is how the points of all contacts that push, and all rows, move with the bodies.
bool ImpulseMatch::factor(const ElasticContacts& contacts, const ElasticTies& ties) {
    const Matched& bodies = contacts.bodies();
    reach_.clear();
    double most = 0;
    for (const ElasticContacts::Contact& c : contacts.contacts()) {
        if (c.q.isZero(0)) continue;
        for (const Side& side : c.sides) {
            if (side.body == kNoIndex) continue;
            const Eigen::Matrix<double, 3, 6> motion = motion_of(bodies, side);
            const Matrix6d own = motion.transpose() * motion;
            reach_.add(side.body, own);
            most += own.trace();
        }
        if (c.sides[0].body != kNoIndex && c.sides[1].body != kNoIndex)
            reach_.add(c.sides[0].body, c.sides[1].body,
                       -motion_of(bodies, c.sides[0]).transpose() * motion_of(bodies, c.sides[1]));
    }
    for (std::size_t i = 0; i < ties.rows().size(); ++i) {
        const TieRow& row = ties.rows()[i];
        if (!ties.yields(i)) continue;
        for (std::uint32_t k = 0; k < row.count; ++k) {
            if (!is_body(bodies, row.side[k])) continue;
            const Vector6d one = motion_of(bodies, row, row.side[k]);
            most += one.squaredNorm();
            for (std::uint32_t l = k; l < row.count; ++l)
                if (is_body(bodies, row.side[l]))
                    reach_.add_product(row.side[k].body, one, row.side[l].body,
                                       motion_of(bodies, row, row.side[l]));
        }
    }
    const double apart = kBeyondReach * (most > 0 ? most / double(bodies.size()) : 1);
    for (std::uint32_t i = 0; i < bodies.size(); ++i) reach_.add(i, apart * Matrix6d::Identity());
    return reach_.factor();
}

/// What bodies have changed by and no impulse accounts for.
void ImpulseMatch::find_missing(const std::vector<Vector3d>& v, const std::vector<Vector3d>& target,
                                const ElasticContacts& contacts, const ElasticTies& ties) {
    const Matched& bodies = contacts.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const ElasticContacts::Body& body = bodies[i];
        missing_[i] << body.mass * (v[body.row] - target[body.row]),
            body.inertia * (v[body.row + 1] - target[body.row + 1]) / body.size;
    }
    for (const ElasticContacts::Contact& c : contacts.contacts())
        for (int i = 0; i < 2; ++i)
            if (c.sides[i].body != kNoIndex)
                missing_[c.sides[i].body] -=
                    ElasticContacts::kSign[i] * motion_of(bodies, c.sides[i]).transpose() * c.q;
    for (std::size_t i = 0; i < ties.rows().size(); ++i) {
        const TieRow& row = ties.rows()[i];
        for (const RowSide& side : row.sides())
            if (is_body(bodies, side))
                missing_[side.body] -=
                    (ties.impulses()[i] * row.length) * motion_of(bodies, row, side);
    }
}

void ImpulseMatch::match(const std::vector<Vector3d>& v, const std::vector<Vector3d>& target,
                         ElasticContacts& contacts, ElasticTies& ties) {
    const Matched& bodies = contacts.bodies();
    if (bodies.empty() || !factor(contacts, ties)) return;
    for (int round = 0; round < kMatches; ++round) {
        find_missing(v, target, contacts, ties);
        reach_.solve(missing_);
        for (ElasticContacts::Contact& c : contacts.contacts()) {
            if (c.q.isZero(0)) continue;
            Vector3d more = Vector3d::Zero();
            for (int i = 0; i < 2; ++i)
                if (c.sides[i].body != kNoIndex)
                    more += ElasticContacts::kSign[i] * motion_of(bodies, c.sides[i]) *
                            missing_[c.sides[i].body];
            c.q += more;
        }
        for (std::size_t i = 0; i < ties.rows().size(); ++i) {
            const TieRow& row = ties.rows()[i];
            if (!ties.yields(i)) continue;
            double more = 0;
            for (const RowSide& side : row.sides())
                if (is_body(bodies, side))
                    more += motion_of(bodies, row, side).dot(missing_[side.body]);
            ties.impulses()[i] += more / row.length;
        }
    }
}

}  // namespace plumb
