// SPDX-License-Identifier: MIT
/// Contacts of this step and of the step before are both sorted, so one walk along both finds what
/// stayed.
#include "contacts/anchors.h"
#include "contacts/contact_pairs.h"
#include "contacts/contact_stages.h"

#include <algorithm>

namespace plumb {
namespace {

/// −1, 0, 1: order of the pairs of bodies.
int compare_pairs(const Contact& x, const Contact& y) {
    if (x.a != y.a) return x.a < y.a ? -1 : 1;
    if (x.b != y.b) return x.b < y.b ? -1 : 1;
    return 0;
}

/// The contacts of one pair, now and in the step before.
struct PairRuns {
    std::size_t now, now_end, old, old_end;
};

std::size_t nearest(const std::vector<Contact>& contacts, std::size_t first, std::size_t last,
                    const Vector3d& point) {
    std::size_t best = first;
    for (std::size_t i = first + 1; i < last; ++i)
        if ((common_point(contacts[i]) - point).squaredNorm() <
            (common_point(contacts[best]) - point).squaredNorm())
            best = i;
    return best;
}

void match_by_feature(ContactTable& c, const PairRuns& run, std::vector<std::uint8_t>& used) {
    for (std::size_t k = run.now; k < run.now_end; ++k)
        for (std::size_t j = run.old; j < run.old_end; ++j)
            if (c.found[k].feature != 0 && c.found[k].feature == c.found_before[j].feature &&
                !used[j]) {
                c.memory[k] = c.memory_before[j];
                c.memory[k].matched = c.memory[k].known = true;
                used[j] = 1;
                break;
            }
}

/// Where features came and went (a corner slid over an edge), the pair keeps its summed impulses:
/// what no contact took over goes to the nearest one.
void hand_on_impulses(ContactTable& c, const PairRuns& run, const std::vector<std::uint8_t>& used) {
    for (std::size_t j = run.old; j < run.old_end; ++j) {
        if (used[j]) continue;
        ContactMemory& heir =
            c.memory[nearest(c.found, run.now, run.now_end, common_point(c.found_before[j]))];
        heir.normal_impulse += c.memory_before[j].normal_impulse;
        heir.friction_impulse += c.memory_before[j].friction_impulse;
        heir.rolling_impulse += c.memory_before[j].rolling_impulse;
        heir.exact |= c.memory_before[j].exact;
        heir.matched = true;
    }
}

/// Whether the pair touches by the very features of the step before.
bool is_unchanged(const ContactTable& c, const PairRuns& run) {
    const auto now = c.found.begin(), old = c.found_before.begin();
    return std::equal(now + run.now, now + run.now_end, old + run.old, old + run.old_end,
                      [](const Contact& x, const Contact& y) {
                          return x.feature != 0 && x.feature == y.feature;
                      });
}

/// `run.old` is empty where the pair is new.
void match_pair(ContactTable& c, const PairRuns& run, std::vector<std::uint8_t>& used) {
    if (is_unchanged(c, run)) {
        for (std::size_t k = run.now; k < run.now_end; ++k) {
            c.memory[k] = c.memory_before[run.old + (k - run.now)];
            c.memory[k].matched = c.memory[k].known = true;
        }
        return;
    }
    std::fill(c.memory.begin() + run.now, c.memory.begin() + run.now_end, ContactMemory{});
    match_by_feature(c, run, used);
    hand_on_impulses(c, run, used);
}

/// The nearest contact of the step before that stuck; run.old_end where none did.
std::size_t nearest_sticking(const ContactTable& c, const PairRuns& run, const Vector3d& point) {
    std::size_t best = run.old_end;
    double least = 0;
    for (std::size_t j = run.old; j < run.old_end; ++j) {
        const double distance = (common_point(c.found_before[j]) - point).squaredNorm();
        if (!c.memory_before[j].sticks || (best < run.old_end && distance >= least)) continue;
        best = j;
        least = distance;
    }
    return best;
}

/// A contact that slid begins to stick anew where it is. One that is new, or carried nothing, takes
/// over the slip of the nearest contact of the pair that stuck, or what the pair has crept would
/// be forgotten with every feature that changes and every corner that lifts for a moment.
void anchor_pair(World& world, const PairRuns& run) {
    ContactTable& c = world.contacts;
    for (std::size_t i = run.now; i < run.now_end; ++i) {
        ContactMemory& m = c.memory[i];
        if (m.sticks || !is_sharp(c.found[i])) continue;
        const bool slid = m.known && m.normal_impulse > 0;
        const Vector3d point = common_point(c.found[i]);
        const std::size_t from = slid ? run.old_end : nearest_sticking(c, run, point);
        Vector3d slip = Vector3d::Zero();
        if (from < run.old_end)
            slip =
                anchor_slip_of({world.bodies, c.found[i].a, c.found[i].b}, c.memory_before[from]);
        set_anchors(m, world.bodies, c.found[i], point, slip);
    }
}

}  // namespace

void match_contacts(World& world, const Plan& plan) {
    ContactTable& c = world.contacts;
    c.memory.resize(c.found.size());
    c.used.assign(c.found_before.size(), 0);
    const bool anchors = plan.runs(Effect::sticking_anchors);
    std::size_t old = 0;
    for (std::size_t i = 0; i < c.found.size();) {
        PairRuns run{i, end_of_pair(c.found, i), 0, 0};
        while (old < c.found_before.size() && compare_pairs(c.found_before[old], c.found[i]) < 0)
            ++old;
        if (old < c.found_before.size() && compare_pairs(c.found_before[old], c.found[i]) == 0)
            run.old = old, run.old_end = old = end_of_pair(c.found_before, old);
        match_pair(c, run, c.used);
        if (anchors) anchor_pair(world, run);
        i = run.now_end;
    }
}

void remember_contacts(World& world) {
    world.contacts.found_before.swap(world.contacts.found);
    world.contacts.memory_before.swap(world.contacts.memory);
}

}  // namespace plumb
