// SPDX-License-Identifier: MIT
/// Which slot of a table each identifier has, where entries come and go.
///
/// Identifiers are counted up and never used twice; slots are. An entry keeps its slot as long as
/// it lives; the next takes the lowest vacant one, or else goes to the end. Vacant slots at the
/// end fall away. Until something is removed, identifiers and slots are the same numbers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

namespace plumb {

class SlotMap {
public:
    struct Entry {
        std::uint32_t id, slot;
    };

    /// What the next `add` gives.
    Entry next() const { return {next_id_, vacant_.empty() ? size_ : *vacant_.begin()}; }

    Entry add() {
        const Entry entry = next();
        entries_.push_back(entry);
        ++next_id_;
        if (vacant_.empty())
            ++size_;
        else
            vacant_.erase(vacant_.begin());
        return entry;
    }

    void remove(std::uint32_t id) {
        const auto at = position(id);
        vacant_.insert(at->slot);
        entries_.erase(at);
        while (!vacant_.empty() && *vacant_.rbegin() + 1 == size_) vacant_.erase(--size_);
    }

    /// After the removal of the entry that was added last: as if it had never been.
    void forget_last() { --next_id_; }

    std::optional<std::uint32_t> find(std::uint32_t id) const {
        if (id < entries_.size() && entries_[id].id == id) return entries_[id].slot;
        const auto at = position(id);
        if (at == entries_.end() || at->id != id) return std::nullopt;
        return at->slot;
    }

    /// Whether there ever was one of this identifier.
    bool knew(std::uint32_t id) const { return id < next_id_; }

    /// Length of the table.
    std::uint32_t size() const { return size_; }

private:
    std::vector<Entry>::const_iterator position(std::uint32_t id) const {
        return std::lower_bound(entries_.begin(), entries_.end(), id,
                                [](const Entry& e, std::uint32_t x) { return e.id < x; });
    }

    std::vector<Entry> entries_;  ///< by id
    std::set<std::uint32_t> vacant_;
    std::uint32_t next_id_ = 0, size_ = 0;
};

}  // namespace plumb
