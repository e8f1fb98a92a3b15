// SPDX-License-Identifier: MIT
/// What keeps the contacts of an island from giving it energy that nothing gives them.
#include "contacts/contact_work.h"
#include "islands/island_substep.h"
#include "islands/work_of_change.h"

namespace plumb {
namespace {

/// Bodies overlap at rest if they move, about their common centre, with less than this share of
/// the energy with which they are to part.
constexpr double kAtRest = 0.25;

/// Of all mass in its common centre.
double energy_of_centre(std::span<const SolvedBody> bodies, std::span<const Vector6d> velocity) {
    double mass = 0;
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        mass += bodies[i].mass, sum += bodies[i].mass * velocity[i].head<3>();
    return 0.5 * sum.squaredNorm() / mass;
}

}  // namespace

/// Where friction turns slip about, the speeds that restitution asks for can be more energy than
/// there was (Kane and Levinson 1985); and what flies about finds overlap wherever it turned into
/// another body, whose push-out is. Then only a share of what is asked for beyond rest is given:
/// energy grows with the share at least in proportion. What overlaps at rest is pushed out all the
/// same.
void IslandSubstep::bound_energy() {
    const double before = energy_at_start(), whole = energy();
    if (whole <= before || (!island_.bounces && rests(before, whole))) return;
    const auto ask_for_more = [&](double share) {
        for (std::size_t k = 0; k < all_.points.size(); ++k)
            all_.points[k].wanted[0] += share * parting_[k];
        island_.solved &= solve_system(island_.effort);
        return energy();
    };
    const double least = ask_for_more(-1);
    if (least < before) ask_for_more((before - least) / (whole - least));
}

/// Whether what is to have the energy `whole` [J] moved by little `before`.
bool IslandSubstep::rests(double before, double whole) const {
    const double centre = energy_of_centre(all_.bodies, start_);
    return before - centre < kAtRest * (whole - centre);
}

/// Sweeps of what flies about and touches nothing else do not give it energy, either: slip that is
/// taken back, and overlap, are worth no more than a share of their impulses that gives none.
void IslandSubstep::bound_swept_energy() {
    const double before = energy_at_start(), whole = energy();
    if (whole <= before || rests(before, whole)) return;
    keep(work_of_change(all_.bodies, start_, all_.velocity).share(0));
}

/// What is wedged between surfaces that are all but parallel leaves many times as fast as these
/// part. Sweeps of a heap that was squeezed, and is left to itself, fling nothing out of it: only
/// such a share of their impulses is taken.
void IslandSubstep::bound_speed() {
    const double share = share_without_flinging(settings_, [&](auto visit) {
        for (std::size_t i = 0; i < start_.size(); ++i)
            visit(start_[i].head<3>(), (all_.velocity[i] - start_[i]).head<3>());
    });
    if (share < 1) keep(share);
}

/// Keeps a share of its impulses.
void IslandSubstep::keep(double share) {
    for (IslandPoint& p : all_.points) p.impulse *= share;
    for (std::size_t i = 0; i < start_.size(); ++i)
        all_.velocity[i] = start_[i] + share * (all_.velocity[i] - start_[i]);
}

}  // namespace plumb
