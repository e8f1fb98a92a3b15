// SPDX-License-Identifier: MIT
/// What the elastic system holds together: particles, the elements, balloons and contacts among
/// them, and the bodies of these contacts.
///
/// Rows of the system are those of the particles, then of kept volumes, then of the bodies.
#pragma once

#include "solve/balloons.h"
#include "solve/elastic_contacts.h"
#include "solve/elements.h"

#include <memory>
#include <vector>

namespace plumb {

struct ElasticParts {
    std::vector<std::unique_ptr<Elements>> elements;
    Balloons balloons;
    std::vector<double> mass;  ///< [particle], 0 of what stays [kg]
    ElasticContacts contacts;
    ElasticTies ties;      ///< of the bodies of these contacts, and of particles
    bool may_have_bodies;  ///< in some step

    std::uint32_t particles() const { return static_cast<std::uint32_t>(mass.size()); }
    std::uint32_t first_balloon_row() const { return particles(); }
    std::uint32_t first_body_row() const { return particles() + balloons.rows(); }
    std::uint32_t rows() const { return first_body_row() + contacts.rows(); }
    /// Whether nothing but deformables moves in this step.
    bool are_alone() const { return contacts.empty() && ties.empty(); }
    /// (v, ω) of the bodies and linked points, out of [row of the system]; and forces on them into
    /// it.
    void gather(const std::vector<Vector3d>& rows, std::vector<Vector6d>& of_bodies) const {
        contacts.gather(rows, of_bodies), ties.gather(rows, of_bodies);
    }
    void add_to_rows(const std::vector<Vector6d>& of_bodies, std::vector<Vector3d>& rows) const {
        contacts.add_to_rows(of_bodies, rows), ties.add_to_rows(of_bodies, rows);
    }
    /// As many as there may be in this step.
    std::size_t most_rows() const { return first_body_row() + 2 * contacts.bodies().capacity(); }
};

ElasticParts elastic_parts(const World& world, const Plan& plan);

}  // namespace plumb
