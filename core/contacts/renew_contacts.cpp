// SPDX-License-Identifier: MIT
#include "contacts/renew_contacts.h"

#include "contacts/reuse_contacts.h"

#include <algorithm>

namespace plumb {
namespace {

/// Walks along the pairs and the contacts that were detected.
class Renewal {
public:
    explicit Renewal(ContactTable& table) : table_(table), kept_(table.kept) {
        kept_.stays.clear(), kept_.comes.clear();
        table_.pairs.clear();
        kept_.reused = 0;
        look();
    }

    void stay(const KeptPair& pair) {
        if (pair.count > 0) table_.pairs.push_back({pair.a, pair.b, new_, pair.count, true});
        add(kept_.stays, pair.first, pair.count);
        kept_.reused += pair.count;
    }

    /// Lets the next contacts come that were detected, of the pairs up to `last` (pair_key).
    /// Returns how many.
    std::uint32_t come(std::uint64_t last) {
        const std::uint32_t first = fresh_;
        while (next_ <= last) come_pair();
        return fresh_ - first;
    }

    /// Leaves them out.
    std::uint32_t skip(std::uint64_t last) {
        const std::uint32_t first = fresh_;
        while (next_ <= last) ++fresh_, look();
        return fresh_ - first;
    }

    static constexpr std::uint64_t kEnd = ~std::uint64_t{0};  ///< beyond the keys of all pairs

private:
    void look() {
        const std::vector<Contact>& found = table_.fresh.found;
        next_ = fresh_ < found.size() ? pair_key(found[fresh_].a, found[fresh_].b) : kEnd;
    }

    void come_pair() {
        const std::uint64_t key = next_;
        const std::uint32_t first = fresh_;
        while (next_ == key) ++fresh_, look();
        const Contact& contact = table_.fresh.found[first];
        table_.pairs.push_back({contact.a, contact.b, new_, fresh_ - first});
        add(kept_.comes, first, fresh_ - first);
    }

    /// In one with the move before where it goes on.
    void add(std::vector<ContactMove>& moves, std::uint32_t from, std::uint32_t count) {
        if (count == 0) return;
        if (!moves.empty() && moves.back().from + moves.back().count == from &&
            moves.back().to + moves.back().count == new_)
            moves.back().count += count;
        else
            moves.push_back({from, new_, count});
        new_ += count;
    }

    ContactTable& table_;
    KeptContacts& kept_;
    std::uint32_t fresh_ = 0, new_ = 0;
    std::uint64_t next_ = kEnd;  // pair_key of the next that was detected
};

/// Moves what stays within a column that has room for all. What goes up must not run into what
/// goes down: nothing does if these begin below and those above, for the order stays.
template <class Row>
void move_within(std::vector<Row>& column, const std::vector<ContactMove>& stays) {
    const auto at = column.begin();
    for (const ContactMove& m : stays)
        if (m.to < m.from) std::move(at + m.from, at + m.from + m.count, at + m.to);
    for (auto m = stays.rbegin(); m != stays.rend(); ++m)
        if (m->to > m->from)
            std::move_backward(at + m->from, at + m->from + m->count, at + m->to + m->count);
}

/// Brings a column to a new size, with everything that stays in its new place.
template <class Row>
void make_room(std::vector<Row>& column, const KeptContacts& kept, std::size_t size) {
    column.resize(std::max(column.size(), size));
    move_within(column, kept.stays);
    column.resize(size);
}

template <class Row>
void replace(std::vector<Row>& column, const std::vector<Row>& fresh, const KeptContacts& kept,
             std::size_t size) {
    make_room(column, kept, size);
    for (const ContactMove& m : kept.comes)
        std::copy_n(fresh.begin() + m.from, m.count, column.begin() + m.to);
}

}  // namespace

std::uint32_t find_moves(World& world) {
    ContactTable& table = world.contacts;
    Renewal renewal(table);
    std::uint32_t unasked = 0, foreign = 0;
    for (KeptPair& pair : table.kept.pairs) {
        const std::uint64_t key = pair_key(pair.a, pair.b);
        foreign += renewal.come(key - 1);
        if (pair.fresh) {
            pair.count = renewal.come(key);
            continue;
        }
        renewal.stay(pair);
        unasked += renewal.skip(key);
    }
    foreign += renewal.come(Renewal::kEnd - 1);
    if (foreign > 0) forget_kept_contacts(world);  // of pairs that were no candidates
    return unasked;
}

std::uint32_t contacts_to_be(const KeptContacts& kept) {
    std::uint32_t count = 0;
    for (const ContactMove& m : kept.stays) count += m.count;
    for (const ContactMove& m : kept.comes) count += m.count;
    return count;
}

void put_in(World& world) {
    ContactTable& table = world.contacts;
    KeptContacts& kept = table.kept;
    const std::size_t size = contacts_to_be(kept);
    replace(table.found, table.fresh.found, kept, size);
    replace(table.memory, table.fresh.memory, kept, size);
    make_room(kept.rides, kept, kept.pairs.empty() && kept.stays.empty() ? 0 : size);
}

}  // namespace plumb
