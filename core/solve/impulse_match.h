// SPDX-License-Identifier: MIT
/// Makes the impulses of the elastic system those that take its bodies, and the free pieces of its
/// deformables, from their targets to their velocities: the firmer a contact or a joint, the more a
/// small error of velocities is one of its impulse.
///
/// A piece is felt as a body is, by its momentum and angular momentum, for what is inside of it
/// changes neither. Were it as fast as impulses that do not match push it (momentum_keeper.h), what
/// Newton's method leaves would throw it.
#pragma once

#include "math/block_cholesky.h"
#include "solve/elastic_contacts.h"
#include "solve/elastic_ties.h"
#include "solve/free_pieces.h"

#include <algorithm>
#include <array>
#include <vector>

namespace plumb {

class ImpulseMatch {
public:
    /// Once a step: what pushes what.
    void load(const ElasticContacts& contacts, const ElasticTies& ties, const FreePieces& pieces);

    /// By the least changes, in the mean of the squares: each impulse changes by G λ, where λ is an
    /// impulse and its moment a body or piece, and G what the contact's points, or the tie's rows,
    /// do not see of them. A single point can give a body no torque, so some of its velocity may
    /// remain without an impulse. Velocities are [row of the system], places [particle].
    void match(const std::vector<Vector3d>& v, const std::vector<Vector3d>& target,
               const std::vector<double>& mass, const std::vector<Vector3d>& place,
               const FreePieces& pieces, ElasticContacts& contacts, ElasticTies& ties);

private:
    using Motion = Eigen::Matrix<double, 3, 6>;
    /// How a contact's velocity changes with that of a body or piece, [row of `reach_`], whose
    /// angular velocity is times `size`.
    struct Seen {
        std::uint32_t row = kNoIndex;
        Motion motion = Motion::Zero();
    };
    /// The same of the rate of a tie's row.
    struct SeenRate {
        std::uint32_t row = kNoIndex;
        Vector6d motion = Vector6d::Zero();
    };
    /// Few, one a row.
    template <class T>
    struct Few {
        std::array<T, 4> of;
        std::uint32_t count = 0;

        T& at(std::uint32_t row) {
            for (std::uint32_t i = 0; i < count; ++i)
                if (of[i].row == row) return of[i];
            of[count].row = row;
            return of[count++];
        }
        bool has(std::uint32_t row) const {
            return std::any_of(begin(), end(), [&](const T& x) { return x.row == row; });
        }
        const T* begin() const { return of.data(); }
        const T* end() const { return of.data() + count; }
    };

    std::uint32_t row_of_piece(std::uint32_t piece) const { return bodies_ + piece; }
    std::uint32_t row_of_tied(std::uint32_t at, const ElasticTies& ties,
                              const FreePieces& pieces) const;
    Few<Seen> seen_by(const ElasticContacts::Contact& contact,
                      const std::vector<ElasticContacts::Body>& bodies, const FreePieces& pieces,
                      const std::vector<Vector3d>& place) const;
    Few<SeenRate> seen_by(const TieRow& row, const std::vector<ElasticContacts::Body>& bodies,
                          const ElasticTies& ties, const FreePieces& pieces) const;
    bool factor(const ElasticContacts& contacts, const ElasticTies& ties);
    void find_missing(const std::vector<Vector3d>& v, const std::vector<Vector3d>& target,
                      const std::vector<double>& mass, const FreePieces& pieces,
                      const ElasticContacts& contacts, const ElasticTies& ties);

    BlockCholesky::Pattern touching_, touching_before_;  ///< pairs of rows of `reach_`
    std::uint32_t bodies_ = 0;               ///< rows of `reach_`: of bodies, then of pieces
    BlockCholesky reach_;                    ///< of all impulses
    std::vector<Few<Seen>> seen_;            ///< [contact]
    std::vector<Few<SeenRate>> seen_rates_;  ///< [row of ties]
    /// [row of `reach_`] impulse, and its moment over `size` [N s]
    std::vector<Vector6d> missing_;
};

}  // namespace plumb
