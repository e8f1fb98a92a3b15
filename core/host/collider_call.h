// SPDX-License-Identifier: MIT
/// Tells which collider's call is under way when the program is about to end in std::terminate.
///
/// No call of a collider may throw, so an exception that leaves one (or a thread that it started)
/// ends in std::terminate, where nothing can be returned to any more. While a call is under way, a
/// handler of ours stands in for the program's own: it finds the sentence, calls what the program
/// has asked for, and goes on to the program's own handler. When the last call returns, the
/// program's own handler is back in its place.
#pragma once

#include <functional>
#include <string>

namespace plumb {

/// What a program does when a collider's call has ended in std::terminate: complete its outputs and
/// leave. It runs on the thread that failed; the thread that made the call does not go on. When it
/// returns, the handler that std::set_terminate had before is called.
using ColliderEnd = std::function<void(const std::string& sentence)>;

/// Replaces what is done; returns what was done before. With none, the sentence goes to stderr.
ColliderEnd set_collider_end(ColliderEnd end);

/// Marks that a call of a collider is under way on this thread.
class ColliderCall {
public:
    /// Both texts must outlive the call.
    ColliderCall(const char* collider, const char* function) noexcept;
    ~ColliderCall();
    ColliderCall(const ColliderCall&) = delete;
    ColliderCall& operator=(const ColliderCall&) = delete;

    const char* collider() const { return collider_; }
    const char* function() const { return function_; }
    const ColliderCall* next() const { return next_; }

private:
    const char* collider_;
    const char* function_;
    ColliderCall* next_ = nullptr;         ///< in the list of all calls under way
    const ColliderCall* outer_ = nullptr;  ///< of this thread
};

}  // namespace plumb
