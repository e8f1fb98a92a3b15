// SPDX-License-Identifier: MIT
#include "schedule/workers.h"

namespace plumb {
namespace {

/// So often a condition is looked for before others may run: a barrier is usually a microsecond
/// away.
constexpr int kSpins = 2000;

/// So often a worker looks for the next step's first task before it sleeps.
constexpr int kIdleSpins = 20000;

template <class Condition>
void wait_until(Condition reached) {
    for (int spins = 0; !reached(); ++spins)
        if (spins > kSpins) std::this_thread::yield();
}

}  // namespace

Workers::Workers(std::uint32_t count) : count_(count > 0 ? count : 1) {
    for (std::uint32_t w = 1; w < count_; ++w)
        threads_.emplace_back([this, w] { wait_for_tasks(w); });
}

Workers::~Workers() {
    stop_ = true;
    ++round_;
    round_.notify_all();
    for (std::thread& t : threads_) t.join();
}

void Workers::run_all(Call call, void* context) {
    if (count_ == 1) return call(context, 0);
    call_ = call;
    context_ = context;
    running_ = count_ - 1;
    ++round_;
    round_.notify_all();
    call(context, 0);
    wait_until([this] { return running_ == 0; });
}

void Workers::barrier() {
    if (count_ == 1) return;
    const std::uint64_t passed = barriers_;
    if (++arrived_ == count_) {
        arrived_ = 0;
        ++barriers_;
    } else {
        wait_until([&] { return barriers_ != passed; });
    }
}

void Workers::wait_for_tasks(std::uint32_t worker) {
    for (std::uint64_t seen = 0;;) {
        for (int spins = 0, idle = 0; round_ == seen;) {
            if (awake_)
                idle = 0;
            else if (++idle > kIdleSpins)
                round_.wait(seen);
            if (awake_ && ++spins > kSpins) std::this_thread::yield();
        }
        ++seen;
        if (stop_) return;
        call_(context_, worker);
        --running_;
    }
}

}  // namespace plumb
