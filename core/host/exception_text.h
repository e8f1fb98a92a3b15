// SPDX-License-Identifier: MIT
/// The words of an exception that came out of a plugin.
#pragma once

#include <exception>
#include <string>

namespace plumb {

/// What the exception that is being handled says of itself; "" where none is being handled.
inline std::string exception_text() {
    const std::exception_ptr current = std::current_exception();
    if (!current) return {};
    try {
        std::rethrow_exception(current);
    } catch (const std::exception& e) {
        return e.what();
    } catch (...) {
        return "an exception of a kind that is not known here";
    }
}

}  // namespace plumb
