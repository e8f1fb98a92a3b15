// SPDX-License-Identifier: MIT
/// Lets no exception out: it becomes a status.
#pragma once

#include <plumb/proximity.h>

#include <new>

namespace plumb {

template <class F>
Status guarded(F f) noexcept {
    try {
        return f();
    } catch (const std::bad_alloc&) {
        return {Status::out_of_memory, 0, "memory ran out"};
    } catch (...) {
        return {Status::failed, 0, "an unexpected exception was caught"};
    }
}

}  // namespace plumb
