// SPDX-License-Identifier: MIT
/// The part of a contact solver's rows in impacts (contacts/impacts.h): what their compression
/// begins from, the restitution after it, and the way back to the substep.
#pragma once

#include "contacts/contact_measures.h"
#include "contacts/impacts.h"
#include "schedule/contact_batches.h"
#include "step/contact_impulses.h"
#include "step/contact_sides.h"
#include "world/world.h"

#include <algorithm>
#include <vector>

namespace plumb {

template <class Real, int W>
class ContactImpacts {
public:
    using Batches = ContactBatches<Real, W>;

    /// Memory for `contacts` of them, so that the first impact allocates none.
    void reserve(Batches& batches, std::size_t contacts) {
        resting_.reserve(batches.arrays(), batches.row_count());
        given_.reserve(contacts), hit_.reserve(contacts);
        is_hit_.reserve(batches.block_count()), blocks_.reserve(batches.block_count());
    }

    /// Puts the impulses of the substep before aside. Rows ask how fast contacts approach, and how
    /// far they may.
    void begin(const ContactTable& c, const Impacts& impacts, const std::vector<BodyPair>& pairs,
               Batches& batches) {
        find_blocks(impacts, pairs, batches);
        const ContactArrays<Real, W> rows = batches.arrays();
        resting_.take(rows, blocks_);
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            if (impacts.is_hit(p) || !is_hit_[batches.slot(p).block]) continue;
            batches.each_contact(pairs, p, [&](const ContactPlace& at) { put_apart(rows, at); });
        }
        each_hit(impacts, pairs, batches, [&](const ContactPlace& at) {
            NormalRow<Real, W>& row = rows.normals[at.row];
            row.gap[at.lane] = static_cast<Real>(gap_in_substep(c, at.contact));
            row.restitution_velocity[at.lane] = 0;
            if (rows.frictions)
                rows.frictions[at.row].anchor_velocity_x[at.lane] =
                    rows.frictions[at.row].anchor_velocity_y[at.lane] = 0;
        });
    }

    /// The blocks in which there is a pair of an island in which bodies collide: the others are
    /// left alone, and what else is in these bears nothing.
    const std::vector<BlockRange>& blocks() const { return blocks_; }

    /// Restitution of the contacts that collided, after their compression. Returns whether there
    /// is any.
    bool give_back(World& world, const Impacts& impacts, const std::vector<BodyPair>& pairs,
                   Batches& batches, const BodyRows<Real>& bodies) {
        ContactTable& c = world.contacts;
        if (c.restitution.empty()) return false;
        const ContactArrays<Real, W> rows = batches.arrays();
        given_.clear(), hit_.clear();
        each_hit(impacts, pairs, batches, [&](const ContactPlace& at) {
            if (c.is_passing(at.contact)) return;
            c.set_restitution(at.contact, 0);
            NormalRow<Real, W>& row = rows.normals[at.row];
            const auto impulse = static_cast<Real>(
                restitution(world, at.contact, double(row.lambda_velocity[at.lane]),
                            double(row.effective_mass[at.lane])));
            hit_.push_back(at.contact);
            if (!(impulse > 0)) return;
            given_.push_back(at);
            push(bodies, sides_of(rows, at), impulse);
            row.lambda_velocity[at.lane] += impulse;
        });
        for (const ContactPlace& at : given_) {
            NormalRow<Real, W>& row = rows.normals[at.row];
            const ContactSides<Real> sides = sides_of(rows, at);
            row.restitution_velocity[at.lane] = std::max(
                Real(0), row.velocity[at.lane] + sides.normal.dot(change_between(bodies, sides)));
            c.bounced[at.contact] = 1;
        }
        return !given_.empty();
    }

    /// Takes the impulses that were put aside up again.
    void end(World& world, Batches& batches) {
        resting_.give(batches.arrays(), blocks_);
        mark_parting(world, hit_);
        hit_.clear();
    }

private:
    /// Calls visit(ContactPlace) for the contacts of islands in which bodies collide.
    template <class Visit>
    static void each_hit(const Impacts& impacts, const std::vector<BodyPair>& pairs,
                         const Batches& batches, Visit visit) {
        for (std::size_t p = 0; p < pairs.size(); ++p)
            if (impacts.is_hit(p)) batches.each_contact(pairs, p, visit);
    }

    static void put_apart(const ContactArrays<Real, W>& rows, const ContactPlace& at) {
        rows.normals[at.row].gap[at.lane] = static_cast<Real>(kOutOfReach);
        rows.normals[at.row].restitution_velocity[at.lane] = 0;
    }

    void find_blocks(const Impacts& impacts, const std::vector<BodyPair>& pairs,
                     const Batches& batches) {
        is_hit_.assign(batches.block_count(), 0);
        for (std::size_t p = 0; p < pairs.size(); ++p)
            if (impacts.is_hit(p)) is_hit_[batches.slot(p).block] = 1;
        blocks_.clear();
        for (const BlockRange& range : batches.ranges())
            for (std::uint32_t first = range.first, last; first < range.last; first = last + 1) {
                for (last = first; last < range.last && is_hit_[last];) ++last;
                if (last > first) blocks_.push_back({first, last, range.independent});
            }
    }

    /// Opposite impulses along the normal [N s].
    static void push(const BodyRows<Real>& bodies, const ContactSides<Real>& sides, Real impulse) {
        const auto take = [&](const ContactSide<Real>& side, const Vector3<Real>& p) {
            if (side.row >= bodies.dynamic_count) return;
            Velocity<Real> change = velocity_in(bodies.change, side.row);
            apply_impulse<Real>(change, side.mass, side.arm, p);
            put_velocity(bodies.change, side.row, change);
        };
        take(sides.a, sides.normal * impulse);
        take(sides.b, sides.normal * -impulse);
    }

    ContactImpulses<Real, W> resting_;
    std::vector<std::uint8_t> is_hit_;  // [block]
    std::vector<BlockRange> blocks_;
    std::vector<ContactPlace> given_;  // which bounced
    std::vector<std::size_t> hit_;     // contacts of islands in which something collided
};

}  // namespace plumb
