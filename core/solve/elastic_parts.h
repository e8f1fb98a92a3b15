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
    ElasticTies ties;  ///< of the bodies of these contacts
    bool may_touch;    ///< whether there can be contacts

    std::uint32_t particles() const { return static_cast<std::uint32_t>(mass.size()); }
    std::uint32_t first_balloon_row() const { return particles(); }
    std::uint32_t first_body_row() const { return particles() + balloons.rows(); }
    std::uint32_t rows() const { return first_body_row() + contacts.rows(); }
    /// As many as there may be in this step.
    std::size_t most_rows() const { return first_body_row() + 2 * contacts.bodies().capacity(); }
};

ElasticParts elastic_parts(const World& world, const Plan& plan);

}  // namespace plumb
