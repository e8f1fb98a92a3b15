// SPDX-License-Identifier: MIT
#include "contacts/contact_room.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace plumb {
namespace {

constexpr unsigned char kGuardByte = 0xa5;
constexpr std::uint32_t kNobody = ~0u;

}  // namespace

void ContactRoom::clear() {
    size_ = 0;
    refused_ = 0;
    overrun_ = false;
    if (memory_.empty()) memory_.resize(kGuard);
    put_up_guard();
}

Contact* ContactRoom::grow(void* ctx, std::uint32_t count) noexcept {
    try {
        return static_cast<ContactRoom*>(ctx)->add(count);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

Contact* ContactRoom::add(std::uint32_t count) {
    overrun_ = overrun();
    if (overrun_) return nullptr;
    if (size_ + count > kMaxContacts) {
        refused_ = size_ + count;
        return nullptr;
    }
    const std::size_t needed = size_ + count + kGuard;
    if (needed > memory_.size()) memory_.resize(std::max(needed, 2 * memory_.size()));
    Contact* room = memory_.data() + size_;
    for (std::uint32_t i = 0; i < count; ++i) room[i].a = room[i].b = kNobody;
    size_ += count;
    put_up_guard();
    return room;
}

void ContactRoom::put_up_guard() {
    std::memset(static_cast<void*>(memory_.data() + size_), kGuardByte, kGuard * sizeof(Contact));
}

bool ContactRoom::guard_is_whole() const {
    if (memory_.empty()) return true;
    const auto* bytes = reinterpret_cast<const unsigned char*>(memory_.data() + size_);
    // all alike: the first is what it was, and each is as the one before it
    return bytes[0] == kGuardByte &&
           std::memcmp(bytes, bytes + 1, kGuard * sizeof(Contact) - 1) == 0;
}

}  // namespace plumb
