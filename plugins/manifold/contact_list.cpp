// SPDX-License-Identifier: MIT
#include "manifold/contact_list.h"

#include <tuple>

namespace plumb {
namespace {

bool before(const Contact& p, const Contact& q) {
    return std::tie(p.a, p.b, p.feature) < std::tie(q.a, q.b, q.feature);
}

bool same_pair(const Contact& p, const Contact& q) { return p.a == q.a && p.b == q.b; }

}  // namespace

std::uint64_t feature_key(std::initializer_list<std::uint64_t> ids) {
    // The finaliser of splitmix64, once for each number.
    std::uint64_t key = 0x9e3779b97f4a7c15u;
    for (std::uint64_t id : ids) {
        key += id + 0x9e3779b97f4a7c15u;
        key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9u;
        key = (key ^ (key >> 27)) * 0x94d049bb133111ebu;
        key ^= key >> 31;
    }
    return key ? key : 1;
}

Contact& ContactList::add(const Part& a, const Part& b) {
    Contact& c = contacts_.emplace_back();
    c.a = a.body;
    c.b = b.body;
    c.part_a = a.index;
    c.part_b = b.index;
    return c;
}

Contact& ContactList::add_particle(std::uint32_t particle, const Part& b) {
    Contact& c = contacts_.emplace_back();
    c.a = particle;
    c.b = b.body;
    c.part_b = b.index;
    return c;
}

void ContactList::finish() {
    // Narrow phases run pair after pair, so mostly only short runs are out of order.
    if (!std::is_sorted(contacts_.begin(), contacts_.end(), [](const Contact& p, const Contact& q) {
            return std::tie(p.a, p.b) < std::tie(q.a, q.b);
        })) {
        std::stable_sort(contacts_.begin(), contacts_.end(), before);
    } else {
        for (auto i = contacts_.begin(); i != contacts_.end();) {
            auto end = i + 1;
            while (end != contacts_.end() && same_pair(*i, *end)) ++end;
            if (end - i > 1) std::sort(i, end, before);
            i = end;
        }
    }
    for (std::size_t i = 1; i < contacts_.size(); ++i)
        if (contacts_[i].feature != 0 && same_pair(contacts_[i - 1], contacts_[i]) &&
            contacts_[i].feature <= contacts_[i - 1].feature)
            contacts_[i].feature = contacts_[i - 1].feature + 1;
}

Status ContactList::write_to(const ContactSink& sink) const {
    if (contacts_.empty()) return ok_status();
    Contact* room = sink.grow(sink.ctx, static_cast<std::uint32_t>(contacts_.size()));
    if (!room) return {Status::out_of_memory, 0, "the sink takes no more contacts"};
    std::copy(contacts_.begin(), contacts_.end(), room);
    return ok_status();
}

std::uint64_t ContactList::pair_count() const {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < contacts_.size(); ++i)
        count += i == 0 || !same_pair(contacts_[i - 1], contacts_[i]);
    return count;
}

}  // namespace plumb
