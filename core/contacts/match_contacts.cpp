// SPDX-License-Identifier: MIT
/// What was detected and the table of the step before are both sorted, so one walk along both finds
/// what goes on.
#include "contacts/anchors.h"
#include "contacts/contact_pairs.h"
#include "contacts/contact_stages.h"
#include "contacts/renew_contacts.h"

#include <algorithm>
#include <span>

namespace plumb {
namespace {

/// The contacts of one pair.
struct PairRun {
    std::span<const Contact> found;
    std::span<ContactMemory> memory;

    PairRun(RememberedContacts& of, const ContactPair& pair)
        : PairRun(of, pair.first, pair.first + pair.count) {}
    PairRun(RememberedContacts& of, std::size_t first, std::size_t end)
        : found(of.found.data() + first, end - first),
          memory(of.memory.data() + first, end - first) {}
    std::size_t size() const { return found.size(); }
};

std::size_t nearest(std::span<const Contact> contacts, const Vector3d& point) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < contacts.size(); ++i)
        if ((common_point(contacts[i]) - point).squaredNorm() <
            (common_point(contacts[best]) - point).squaredNorm())
            best = i;
    return best;
}

/// What a contact remembers is what the one of its feature did, or nothing. `used`: of the contacts
/// before, whether one has taken over their memory.
void match_by_feature(const PairRun& now, const PairRun& before, std::vector<std::uint8_t>& used) {
    for (std::size_t k = 0; k < now.size(); ++k) {
        const std::uint64_t feature = now.found[k].feature;
        std::size_t j = 0;
        while (j < before.size() && (before.found[j].feature != feature || used[j])) ++j;
        if (feature == 0 || j == before.size()) {
            now.memory[k] = ContactMemory{};
            continue;
        }
        now.memory[k] = before.memory[j];
        now.memory[k].matched = now.memory[k].known = true;
        used[j] = 1;
    }
}

/// Where features came and went (a corner slid over an edge), the pair keeps its summed impulses:
/// what no contact took over goes to the nearest one.
void hand_on_impulses(const PairRun& now, const PairRun& before,
                      const std::vector<std::uint8_t>& used) {
    for (std::size_t j = 0; j < before.size(); ++j) {
        if (used[j]) continue;
        ContactMemory& heir = now.memory[nearest(now.found, common_point(before.found[j]))];
        const ContactMemory& memory = before.memory[j];
        heir.normal_impulse += memory.normal_impulse;
        heir.friction_impulse += memory.friction_impulse;
        heir.rolling_impulse += memory.rolling_impulse;
        heir.exact |= memory.exact;
        heir.missed = std::max(heir.missed, memory.missed);
        heir.moved |= memory.moved;
        heir.matched = true;
    }
}

/// `before` is empty where the pair is new.
void match_pair(const PairRun& now, const PairRun& before, std::vector<std::uint8_t>& used) {
    used.assign(before.size(), 0);
    match_by_feature(now, before, used);
    hand_on_impulses(now, before, used);
}

/// The nearest contact before that stuck; before.size() where none did.
std::size_t nearest_sticking(const PairRun& before, const Vector3d& point) {
    std::size_t best = before.size();
    double least = 0;
    for (std::size_t j = 0; j < before.size(); ++j) {
        if (!before.memory[j].sticks) continue;
        const double distance = (common_point(before.found[j]) - point).squaredNorm();
        if (best < before.size() && distance >= least) continue;
        best = j;
        least = distance;
    }
    return best;
}

/// A contact that slid begins to stick anew where it is. One that is new, or carried nothing, takes
/// over the slip of the nearest contact of the pair that stuck, or what the pair has crept would
/// be forgotten with every feature that changes and every corner that lifts for a moment.
void anchor_pair(const PairPoses& poses, const PairRun& now, const PairRun& before) {
    for (std::size_t i = 0; i < now.size(); ++i) {
        ContactMemory& m = now.memory[i];
        const Contact& contact = now.found[i];
        if (m.sticks || !is_sharp(contact)) continue;
        const bool slid = m.known && m.normal_impulse > 0;
        const Vector3d point = common_point(contact);
        const std::size_t from = slid ? before.size() : nearest_sticking(before, point);
        Vector3d slip = Vector3d::Zero();
        if (from < before.size()) slip = anchor_slip_of(poses, before.memory[from]);
        set_anchors(m, poses, point, slip);
    }
}

/// The first contact from `at` on that is of the pair of another one, or of a later pair: most
/// often one of the next.
std::size_t skip_to(const std::vector<Contact>& contacts, std::size_t at, const Contact& other) {
    const auto is_earlier = [](const Contact& x, const Contact& y) {
        return bodies_of(x) < bodies_of(y);
    };
    std::size_t far = 1;
    for (; at + far < contacts.size() && is_earlier(contacts[at + far], other); far *= 2) at += far;
    const auto first = contacts.begin() + static_cast<std::ptrdiff_t>(at);
    const auto last =
        contacts.begin() + static_cast<std::ptrdiff_t>(std::min(at + far, contacts.size()));
    return static_cast<std::size_t>(std::lower_bound(first, last, other, is_earlier) -
                                    contacts.begin());
}

/// The first contact from `at` on that begins a pair.
std::size_t next_pair(const std::vector<Contact>& contacts, std::size_t at) {
    while (at > 0 && at < contacts.size() && bodies_of(contacts[at]) == bodies_of(contacts[at - 1]))
        ++at;
    return at;
}

/// Any pair may come to any worker.
void make_room_for_pairs(ContactTable& c, Workers& workers) {
    std::uint32_t most = 0;
    for (const ContactPair& pair : c.pairs) most = std::max(most, pair.count);
    c.before.resize(workers.count());
    for (PairBefore& pair : c.before) {
        pair.used.reserve(most);
        pair.contacts.found.reserve(most), pair.contacts.memory.reserve(most);
    }
}

void match_fresh(World& world, bool anchors, Workers& workers) {
    ContactTable& table = world.contacts;
    RememberedContacts& fresh = table.fresh;
    fresh.memory.resize(fresh.found.size());
    workers.share_out(fresh.found.size(), [&](Range share, std::uint32_t worker) {
        const std::size_t last = next_pair(fresh.found, share.last);
        std::size_t old = 0;
        for (std::size_t i = next_pair(fresh.found, share.first), end; i < last; i = end) {
            end = end_of_pair(fresh.found, i);
            old = skip_to(table.found, old, fresh.found[i]);
            const std::size_t first = old;
            if (old < table.found.size() &&
                bodies_of(table.found[old]) == bodies_of(fresh.found[i]))
                old = end_of_pair(table.found, old);
            const PairRun now(fresh, i, end), before(table, first, old);
            match_pair(now, before, table.before[worker].used);
            if (anchors && std::any_of(now.found.begin(), now.found.end(), is_sharp))
                anchor_pair(PairPoses(table.frames, now.found[0].a, now.found[0].b), now, before);
        }
    });
}

/// Contacts of a pair that stay, where one of them slid or carried nothing: with a copy of what the
/// pair remembers, for each looks at the others of before.
void anchor_kept(const PairPoses& poses, const PairRun& now, RememberedContacts& copy) {
    bool any = false;
    for (std::size_t i = 0; i < now.size(); ++i)
        any |= is_sharp(now.found[i]) && !now.memory[i].sticks;
    if (!any) return;
    copy.found.assign(now.found.begin(), now.found.end());
    copy.memory.assign(now.memory.begin(), now.memory.end());
    anchor_pair(poses, now, PairRun(copy, 0, now.size()));
}

/// What stays is brought to the poses now, where it rides on; what comes rides from here.
void ride(World& world, bool anchors, Workers& workers) {
    ContactTable& c = world.contacts;
    KeptContacts& kept = c.kept;
    const bool keeps = !kept.pairs.empty();
    workers.each(c.pairs.size(), [&](std::uint32_t p, std::uint32_t worker) {
        const ContactPair& pair = c.pairs[p];
        if (!pair.stays && !keeps) return;
        const PairPoses poses(c.frames, pair.a, pair.b);
        for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i)
            if (pair.stays)
                poses.put_into_world(c.found[i], kept.rides[i]);
            else
                kept.rides[i] = poses.put_into_bodies(c.found[i]);
        if (pair.stays && anchors) anchor_kept(poses, PairRun(c, pair), c.before[worker].contacts);
    });
    if (!keeps) kept.rides.clear();
}

}  // namespace

void match_contacts(World& world, const Plan& plan, Workers& workers) {
    const bool anchors = plan.runs(Effect::sticking_anchors);
    make_room_for_pairs(world.contacts, workers);
    find_frames(world.bodies, world.contacts.frames, workers);
    match_fresh(world, anchors, workers);
    put_in(world);
    ride(world, anchors, workers);
}

}  // namespace plumb
