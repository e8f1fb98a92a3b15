// SPDX-License-Identifier: MIT
#include "ties/tied_links.h"

#include "constraints/points.h"
#include "math/rotation.h"
#include "ties/linked_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {

void TiedLinks::add(std::uint32_t link, const TiedBodies& at) {
    Member& m = links_.emplace_back();
    m.link = link;
    m.a = at[0], m.b = at[1];
}

void TiedLinks::begin(const World& world, const SubstepTime& time, std::uint32_t i,
                      std::vector<TieRow>& rows) {
    Member& m = links_[i];
    const Link& link = world.links[m.link];
    m.at_a = linked_point(world, link.a), m.at_b = linked_point(world, link.b);
    m.scripted_a = scripted_velocity(world.bodies, link.a.body);
    m.scripted_b = scripted_velocity(world.bodies, link.b.body);
    const Vector3d apart = m.at_a.start - m.at_b.start;
    m.length = apart.norm();
    m.line = line_of(apart);
    const double damped = link.compliance * link.damping;
    m.lag = point_lag(damped, time.h);
    m.first_row = static_cast<std::uint32_t>(rows.size());
    const auto add_row = [&](double rest, double lowest, double highest) {
        m.rest[rows.size() - m.first_row] = rest;
        TieRow& row = rows.emplace_back();
        Vector6d on;
        on << m.line, m.at_a.arm.cross(m.line);
        row.add_side(m.a, on);
        on << -m.line, -m.at_b.arm.cross(m.line);
        row.add_side(m.b, on);
        row.mass = 1 / line_response(m.at_a, m.at_b, m.line);
        row.softness = point_softness(link.compliance, damped, time.h);
        row.lowest = lowest, row.highest = highest;
        row.impulse = std::clamp(link.impulse.dot(m.line), lowest, highest);
    };
    constexpr double any = std::numeric_limits<double>::infinity();
    if (link.shortest == link.longest) {
        add_row(link.longest, -any, any);
    } else {
        add_row(link.longest, -any, 0);
        if (link.shortest > 0) add_row(link.shortest, 0, any);
    }
    m.last_row = static_cast<std::uint32_t>(rows.size());
}

double TiedLinks::ask(std::uint32_t i, std::span<const Vector6d> velocity, double h,
                      std::vector<TieRow>& rows) const {
    const Member& m = links_[i];
    const auto moved = [&](const Velocity<double>& v, const LinkedPoint& p) -> Vector3d {
        return h * v.v + Turn<double>(Vector3d(h * v.w)).change(p.arm);
    };
    const Vector3d apart = m.at_a.start - m.at_b.start +
                           moved(velocity_of(m.a, m.scripted_a, velocity), m.at_a) -
                           moved(velocity_of(m.b, m.scripted_b, velocity), m.at_b);
    const double length = apart.norm();
    double worst = 0;
    for (std::uint32_t k = m.first_row; k < m.last_row; ++k) {
        TieRow& row = rows[k];
        const double rest = m.rest[k - m.first_row];
        const double open = (length - rest) - m.lag * (m.length - rest);
        row.wanted = rate_of(row, velocity) - open / h;
        const double error = open + h * row.softness * row.impulse;
        const bool is_slack = row.impulse == 0 && (row.highest == 0 ? error < 0 : error > 0);
        if (!row.is_one_sided() || !is_slack) worst = std::max(worst, std::abs(error));
    }
    return worst;
}

void TiedLinks::store_impulses(std::uint32_t i, const std::vector<TieRow>& rows,
                               std::vector<Link>& links) const {
    const Member& m = links_[i];
    double sum = 0;
    for (std::uint32_t k = m.first_row; k < m.last_row; ++k) sum += rows[k].impulse;
    links[m.link].impulse = sum * m.line;
}

}  // namespace plumb
