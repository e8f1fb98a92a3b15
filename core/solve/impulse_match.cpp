// SPDX-License-Identifier: MIT
#include "solve/impulse_match.h"

#include "math/matrices.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// This share of the mean diagonal is added to the diagonal, so that what no impulse can change is
/// left as it is.
constexpr double kBeyondReach = 1e-7;
constexpr int kMatches = 3;

using Matched = std::vector<ElasticContacts::Body>;
using Side = ElasticContacts::Side;

}  // namespace

/// Of a body or the piece of a point that is tied; or kNoIndex, if its momentum is nobody's.
std::uint32_t ImpulseMatch::row_of_tied(std::uint32_t at, const ElasticTies& ties,
                                        const FreePieces& pieces) const {
    if (at < bodies_) return at;
    const std::uint32_t piece = pieces.piece_of(ties.particle(at));
    return piece == kNoIndex ? kNoIndex : row_of_piece(piece);
}

void ImpulseMatch::load(const ElasticContacts& contacts, const ElasticTies& ties,
                        const FreePieces& pieces) {
    const Matched& bodies = contacts.bodies();
    bodies_ = static_cast<std::uint32_t>(bodies.size());
    const std::uint32_t rows = row_of_piece(pieces.size());
    std::swap(touching_, touching_before_);
    touching_.clear();
    const std::size_t most = contacts.contacts().capacity();
    for (auto* pairs : {&touching_, &touching_before_}) pairs->reserve(most);
    seen_.reserve(most);
    seen_rates_.reserve(ties.rows().size());
    const auto touch = [&](std::uint32_t i, std::uint32_t j) {
        const std::pair now(i, j);
        if (i != j && (touching_.empty() || touching_.back() != now)) touching_.push_back(now);
    };
    for (const ElasticContacts::Contact& c : contacts.contacts()) {
        Few<Seen> seen;
        for (const Side& side : c.sides)
            if (side.body != kNoIndex) seen.at(side.body);
        for (std::uint32_t k = 0; k < c.points; ++k) {
            const std::uint32_t piece = pieces.piece_of(c.particle[k]);
            if (piece != kNoIndex) seen.at(row_of_piece(piece));
        }
        for (const Seen& a : seen)
            for (const Seen& b : seen)
                if (&a < &b) touch(a.row, b.row);
    }
    ties.each_pair([&](std::uint32_t a, std::uint32_t b) {
        const std::uint32_t i = row_of_tied(a, ties, pieces), j = row_of_tied(b, ties, pieces);
        if (i != kNoIndex && j != kNoIndex) touch(i, j);
    });
    const std::size_t most_rows = bodies.capacity() + pieces.size();
    missing_.reserve(most_rows);
    missing_.resize(rows);
    reach_.reserve(static_cast<std::uint32_t>(most_rows));
    if (reach_.rows() != rows || touching_ != touching_before_) reach_.analyse(rows, touching_);
}

/// A triangle bears the couple of what touches it (triangle_couple.h): it is pushed where that is.
/// What a piece pushes within itself does not move it.
ImpulseMatch::Few<ImpulseMatch::Seen> ImpulseMatch::seen_by(
    const ElasticContacts::Contact& c, const Matched& bodies, const FreePieces& pieces,
    const std::vector<Vector3d>& place) const {
    Few<Seen> seen;
    const auto move = [&](std::uint32_t row, double weight, const Vector3d& arm, double size) {
        Motion& motion = seen.at(row).motion;
        motion.leftCols<3>() += weight * Matrix3d::Identity();
        motion.rightCols<3>() -= weight / size * skew(arm);
    };
    for (int i = 0; i < 2; ++i) {
        const Side& side = c.sides[i];
        if (side.body == kNoIndex) continue;
        move(side.body, ElasticContacts::kSign[i], side.arm, bodies[side.body].size);
    }
    if (c.is_between_particles() &&
        pieces.piece_of(c.particle[0]) == pieces.piece_of(c.particle[3]))
        return seen;
    Vector3d apart = Vector3d::Zero();
    if (c.is_between_particles())
        for (std::uint32_t k = 0; k < c.points; ++k) apart += c.weight[k] * place[c.particle[k]];
    for (std::uint32_t k = 0; k < c.points; ++k) {
        const std::uint32_t piece = pieces.piece_of(c.particle[k]);
        if (piece == kNoIndex) continue;
        Vector3d arm = pieces.arm(c.particle[k]);
        if (c.weight[k] < 0) arm += apart;
        move(row_of_piece(piece), c.weight[k], arm, pieces[piece].size);
    }
    return seen;
}

/// Of turning over the row's length.
ImpulseMatch::Few<ImpulseMatch::SeenRate> ImpulseMatch::seen_by(const TieRow& row,
                                                                const Matched& bodies,
                                                                const ElasticTies& ties,
                                                                const FreePieces& pieces) const {
    Few<SeenRate> seen;
    for (const RowSide& side : row.sides()) {
        const std::uint32_t at = row_of_tied(side.body, ties, pieces);
        if (at == kNoIndex) continue;
        Vector6d on = side.on / row.length;
        if (side.body < bodies_) {
            on.tail<3>() /= bodies[side.body].size;
        } else {
            const std::uint32_t particle = ties.particle(side.body);
            on.tail<3>() =
                pieces.arm(particle).cross(on.head<3>()) / pieces[pieces.piece_of(particle)].size;
        }
        if (seen.has(at)) return {};  // within a piece
        seen.at(at).motion = on;
    }
    return seen;
}

/// Gᵀ G, where G is how the points of all contacts that push, and all rows, move with the bodies
/// and pieces.
bool ImpulseMatch::factor(const ElasticContacts& contacts, const ElasticTies& ties) {
    reach_.clear();
    double most = 0;
    for (std::size_t n = 0; n < seen_.size(); ++n) {
        if (contacts.contacts()[n].q.isZero(0)) continue;
        for (const Seen& a : seen_[n]) {
            const Matrix6d own = a.motion.transpose() * a.motion;
            reach_.add(a.row, own);
            most += own.trace();
            for (const Seen& b : seen_[n])
                if (&a < &b) reach_.add(a.row, b.row, a.motion.transpose() * b.motion);
        }
    }
    for (std::size_t n = 0; n < seen_rates_.size(); ++n) {
        if (!ties.yields(n)) continue;
        for (const SeenRate& a : seen_rates_[n]) {
            most += a.motion.squaredNorm();
            for (const SeenRate& b : seen_rates_[n])
                if (&a <= &b) reach_.add_product(a.row, a.motion, b.row, b.motion);
        }
    }
    const double apart = kBeyondReach * (most > 0 ? most / double(reach_.rows()) : 1);
    for (std::uint32_t i = 0; i < reach_.rows(); ++i) reach_.add(i, apart * Matrix6d::Identity());
    return reach_.factor();
}

/// What bodies and pieces have changed by and no impulse accounts for.
void ImpulseMatch::find_missing(const std::vector<Vector3d>& v, const std::vector<Vector3d>& target,
                                const std::vector<double>& mass, const FreePieces& pieces,
                                const ElasticContacts& contacts, const ElasticTies& ties) {
    const Matched& bodies = contacts.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const ElasticContacts::Body& body = bodies[i];
        missing_[i] << body.mass * (v[body.row] - target[body.row]),
            body.inertia * (v[body.row + 1] - target[body.row + 1]) / body.size;
    }
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
        Vector6d& sum = missing_[row_of_piece(i)];
        sum.setZero();
        if (pieces[i].is_left) continue;
        pieces.each_member(pieces[i], [&](std::uint32_t k) {
            const Vector3d change = mass[k] * (v[k] - target[k]);
            sum.head<3>() += change;
            sum.tail<3>() += pieces.arm(k).cross(change) / pieces[i].size;
        });
    }
    for (std::size_t n = 0; n < seen_.size(); ++n)
        for (const Seen& a : seen_[n])
            missing_[a.row] -= a.motion.transpose() * contacts.contacts()[n].q;
    for (std::size_t n = 0; n < seen_rates_.size(); ++n)
        for (const SeenRate& a : seen_rates_[n])
            missing_[a.row] -= (ties.impulses()[n] * ties.rows()[n].length) * a.motion;
}

void ImpulseMatch::match(const std::vector<Vector3d>& v, const std::vector<Vector3d>& target,
                         const std::vector<double>& mass, const std::vector<Vector3d>& place,
                         const FreePieces& pieces, ElasticContacts& contacts, ElasticTies& ties) {
    if (reach_.rows() == 0) return;
    const Matched& bodies = contacts.bodies();
    seen_.clear(), seen_rates_.clear();
    for (const ElasticContacts::Contact& c : contacts.contacts())
        seen_.push_back(seen_by(c, bodies, pieces, place));
    for (const TieRow& row : ties.rows()) seen_rates_.push_back(seen_by(row, bodies, ties, pieces));
    if (!factor(contacts, ties)) return;
    for (int round = 0; round < kMatches; ++round) {
        find_missing(v, target, mass, pieces, contacts, ties);
        reach_.solve(missing_);
        for (std::size_t n = 0; n < seen_.size(); ++n) {
            ElasticContacts::Contact& c = contacts.contacts()[n];
            if (c.q.isZero(0)) continue;
            Vector3d more = Vector3d::Zero();
            for (const Seen& a : seen_[n]) more += a.motion * missing_[a.row];
            c.q += more;
        }
        for (std::size_t n = 0; n < seen_rates_.size(); ++n) {
            if (!ties.yields(n)) continue;
            double more = 0;
            for (const SeenRate& a : seen_rates_[n]) more += a.motion.dot(missing_[a.row]);
            ties.impulses()[n] += more / ties.rows()[n].length;
        }
    }
}

}  // namespace plumb
