// SPDX-License-Identifier: MIT
#include "ties/tied_links.h"

#include "constraints/points.h"
#include "math/rotation.h"
#include "ties/linked_point.h"

#include <algorithm>
#include <cmath>

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
    m.joins = link.joins;
    m.at_a = linked_point(world, link.a), m.at_b = linked_point(world, link.b);
    m.scripted_a = scripted_velocity(world.bodies, link.a.body);
    m.scripted_b = scripted_velocity(world.bodies, link.b.body);
    m.apart = m.at_a.start - m.at_b.start;
    m.first_row = m.last_row = static_cast<std::uint32_t>(rows.size());
    m.arm_b = m.at_b.arm;
    if (m.joins) {
        m.lag = 0;
        // at one common point, that of a: opposite impulses keep angular momentum
        m.arm_b += m.apart;
        const double softness = point_softness(link.compliance, 0, time.h);
        for (int axis = 0; axis < 3; ++axis)
            add_row(m, link, Vector3d::Unit(axis), 0, softness, rows);
        return;
    }
    const double damped = link.compliance * link.damping;
    m.lag = point_lag(damped, time.h);
    const double softness = point_softness(link.compliance, damped, time.h);
    const Vector3d line = line_of(m.apart);
    add_row(m, link, line, link.longest, softness, rows);
    if (link.shortest == link.longest) return;
    rows.back().highest = 0;
    if (link.shortest > 0) {
        add_row(m, link, line, link.shortest, softness, rows);
        rows.back().lowest = 0;
    }
    for (std::uint32_t k = m.first_row; k < m.last_row; ++k)
        rows[k].impulse = std::clamp(rows[k].impulse, rows[k].lowest, rows[k].highest);
}

void TiedLinks::add_row(Member& m, const Link& link, const Vector3d& line, double rest,
                        double softness, std::vector<TieRow>& rows) {
    m.line[m.last_row - m.first_row] = line, m.rest[m.last_row - m.first_row] = rest;
    ++m.last_row;
    TieRow& row = rows.emplace_back();
    Vector6d on;
    on << line, m.at_a.arm.cross(line);
    row.add_side(m.a, on);
    on << -line, -m.arm_b.cross(line);
    row.add_side(m.b, on);
    row.mass = 1 / line_response(m.at_a, {m.at_b.start, m.arm_b, m.at_b.inverse}, line);
    row.softness = softness;
    row.impulse = link.impulse.dot(line);
}

Vector3d TiedLinks::apart_at_end(const Member& m, std::span<const Vector6d> velocity, double h) {
    const auto moved = [&](const Velocity<double>& v, const LinkedPoint& p) -> Vector3d {
        return h * v.v + Turn<double>(Vector3d(h * v.w)).change(p.arm);
    };
    return m.apart + moved(velocity_of(m.a, m.scripted_a, velocity), m.at_a) -
           moved(velocity_of(m.b, m.scripted_b, velocity), m.at_b);
}

double TiedLinks::ask(std::uint32_t i, std::span<const Vector6d> velocity, double h,
                      std::vector<TieRow>& rows) const {
    const Member& m = links_[i];
    const Vector3d apart = apart_at_end(m, velocity, h);
    const auto length_of = [&](const Vector3d& between, const Vector3d& line) {
        return m.joins ? line.dot(between) : between.norm();
    };
    double worst = 0;
    for (std::uint32_t k = m.first_row; k < m.last_row; ++k) {
        TieRow& row = rows[k];
        const Vector3d& line = m.line[k - m.first_row];
        const double rest = m.rest[k - m.first_row];
        const double open =
            (length_of(apart, line) - rest) - m.lag * (length_of(m.apart, line) - rest);
        row.wanted = rate_of(row, velocity) - open / h;
        const double error = open + h * row.softness * row.impulse;
        const bool is_slack = row.impulse == 0 && (row.highest == 0 ? error < 0 : error > 0);
        if (!row.is_one_sided() || !is_slack) worst = std::max(worst, std::abs(error));
    }
    return worst;
}

double TiedLinks::scripted_speed(std::uint32_t i) const {
    const Member& m = links_[i];
    const auto speed = [](std::uint32_t body, const Velocity<double>& v, const LinkedPoint& p) {
        return body == kImmovable ? velocity_at(v, p.arm).norm() : 0.0;
    };
    return std::max(speed(m.a, m.scripted_a, m.at_a), speed(m.b, m.scripted_b, m.at_b));
}

void TiedLinks::store_impulses(std::uint32_t i, const std::vector<TieRow>& rows,
                               std::vector<Link>& links) const {
    const Member& m = links_[i];
    Vector3d sum = Vector3d::Zero();
    for (std::uint32_t k = m.first_row; k < m.last_row; ++k)
        sum += rows[k].impulse * m.line[k - m.first_row];
    links[m.link].impulse = sum;
}

}  // namespace plumb
