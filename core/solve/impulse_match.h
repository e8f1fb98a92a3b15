// SPDX-License-Identifier: MIT
/// Makes the impulses on the bodies of the elastic system those that take them from their targets
/// to their velocities: the firmer a contact or a joint, the more a small error of velocities is
/// one of its impulse.
#pragma once

#include "math/block_cholesky.h"
#include "solve/elastic_contacts.h"
#include "solve/elastic_ties.h"

#include <vector>

namespace plumb {

class ImpulseMatch {
public:
    /// Once a step: which bodies push each other.
    void load(const ElasticContacts& contacts, const ElasticTies& ties);

    /// By the least changes, in the mean of the squares: each impulse changes by G λ, where λ is an
    /// impulse and its moment a body, and G what the contact's points, or the tie's rows, do not
    /// see of them. A single point can give a body no torque, so some of its velocity may remain
    /// without an impulse. Velocities are [row of the system].
    void match(const std::vector<Vector3d>& v, const std::vector<Vector3d>& target,
               ElasticContacts& contacts, ElasticTies& ties);

private:
    bool factor(const ElasticContacts& contacts, const ElasticTies& ties);
    void find_missing(const std::vector<Vector3d>& v, const std::vector<Vector3d>& target,
                      const ElasticContacts& contacts, const ElasticTies& ties);

    BlockCholesky::Pattern touching_, touching_before_;  ///< pairs of bodies
    BlockCholesky reach_;                                ///< of all impulses
    std::vector<Vector6d> missing_;  ///< [body] impulse, and its moment over `size` [N s]
};

}  // namespace plumb
