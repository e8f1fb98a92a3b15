// SPDX-License-Identifier: MIT
#include "solve/elastic_parts.h"

#include "constraints/formulas.h"

namespace plumb {

ElasticParts elastic_parts(const World& world, const Plan& plan) {
    ElasticParts parts{
        make_elements(world, world.settings.dt / world.settings.substeps, Formulas()),
        Balloons(world),
        {},
        ElasticContacts(plan),
        ElasticTies(world),
        false};
    parts.may_have_bodies = has_elastic_contacts(plan) || !parts.ties.points().empty();
    const Particles& p = world.particles;
    for (std::size_t i = 0; i < p.size(); ++i)
        parts.mass.push_back(p.inverse_mass[i] > 0 ? p.mass[i] : 0);
    return parts;
}

}  // namespace plumb
