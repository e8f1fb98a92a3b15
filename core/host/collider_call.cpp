// SPDX-License-Identifier: MIT
#include "host/collider_call.h"

#include "host/exception_text.h"
#include "host/log.h"

#include <cstdlib>
#include <exception>
#include <mutex>

namespace plumb {
namespace {

/// All calls under way in the process. Never destroyed: a call may outlast the end of main.
struct Calls {
    std::mutex mutex;
    ColliderCall* first = nullptr;
    std::terminate_handler before = nullptr;  ///< the program's own, while a call is under way
    ColliderEnd end;
};
Calls& calls() {
    static Calls& all = *new Calls;
    return all;
}

thread_local const ColliderCall* own_call = nullptr;
thread_local bool ending = false;

/// Whose call it was. A thread that a collider started has no call of its own: then it was one of
/// those under way.
std::string culprit() {
    if (own_call) return std::string("collider \"") + own_call->collider() + '"';
    std::string names;
    for (const ColliderCall* c = calls().first; c; c = c->next())
        names += (names.empty() ? "\"" : "\" or \"") + std::string(c->collider());
    return "collider " + names + '"';
}

std::string sentence() {
    const ColliderCall* call = own_call ? own_call : calls().first;
    const std::string who = culprit(), where = call->function();
    const std::string text = exception_text();
    if (!std::current_exception()) return who + " called std::terminate in " + where;
    return who + " let an exception out of " + where +
           (own_call ? "" : ", on a thread of its own") + ": " + text;
}

[[noreturn]] void pass_on(std::terminate_handler before) {
    if (before) before();
    std::abort();
}

/// Keeps the lock for good: no call under way returns from here on, and no other thread ends the
/// program while the outputs are completed.
[[noreturn]] void on_terminate() {
    if (ending) pass_on(calls().before);
    ending = true;
    calls().mutex.lock();
    if (!calls().first)
        pass_on(std::get_terminate() == on_terminate ? nullptr : std::get_terminate());
    const std::string said = sentence();
    if (calls().end)
        calls().end(said);
    else
        logger()->critical(said);
    pass_on(calls().before);
}

}  // namespace

ColliderEnd set_collider_end(ColliderEnd end) {
    const std::lock_guard lock(calls().mutex);
    std::swap(end, calls().end);
    return end;
}

ColliderCall::ColliderCall(const char* collider, const char* function) noexcept
    : collider_(collider), function_(function) {
    const std::lock_guard lock(calls().mutex);
    if (!calls().first) calls().before = std::set_terminate(on_terminate);
    next_ = calls().first;
    calls().first = this;
    outer_ = own_call;
    own_call = this;
}

ColliderCall::~ColliderCall() {
    const std::lock_guard lock(calls().mutex);
    own_call = outer_;
    ColliderCall** link = &calls().first;
    while (*link != this) link = &(*link)->next_;
    *link = next_;
    // Who has set a handler of his own meanwhile keeps it.
    if (!calls().first && std::get_terminate() == on_terminate) std::set_terminate(calls().before);
}

}  // namespace plumb
