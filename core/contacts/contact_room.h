// SPDX-License-Identifier: MIT
/// What stands behind a sink: room for contacts, with guard space behind it.
///
/// A collider that writes more contacts than it asked for writes into the guard space, and is found
/// out instead of spoiling other memory. Room that was asked for and never written to holds
/// contacts of no body.
#pragma once

#include <plumb/contact_set.h>

#include <cstddef>
#include <vector>

namespace plumb {

class ContactRoom {
public:
    /// Contacts that fit behind the room before other memory is hit.
    static constexpr std::size_t kGuard = 64;

    void clear();

    /// Valid as long as the room stays where it is.
    ContactSink sink() { return {this, grow}; }

    const Contact* begin() const { return memory_.data(); }
    const Contact* end() const { return memory_.data() + size_; }

    /// Whether something was written behind the room that was asked for.
    bool overrun() const { return overrun_ || !guard_is_whole(); }

    /// How many contacts a request was for that was refused as too many; 0: none was.
    std::uint64_t refused() const { return refused_; }

private:
    static Contact* grow(void* ctx, std::uint32_t count) noexcept;
    Contact* add(std::uint32_t count);
    void put_up_guard();
    bool guard_is_whole() const;

    std::vector<Contact> memory_;  ///< room, guard, and space to grow into
    std::size_t size_ = 0;         ///< contacts that were asked for
    std::uint64_t refused_ = 0;
    bool overrun_ = false;
};

}  // namespace plumb
