// SPDX-License-Identifier: MIT
#include "schedule/workers.h"

#include <chrono>

namespace plumb {
namespace {

/// So often a condition is looked for before others may run: a barrier is usually a microsecond
/// away.
constexpr int kSpins = 2000;

/// So often a worker looks for the next step's first task before it sleeps.
constexpr int kIdleSpins = 20000;

/// Who lets others run comes back at once unless these want the processor for themselves. Then
/// looking on would take it from the very worker that is waited for: one sleeps until it is
/// notified, and so do all teams for so many waits, by which those that have work to do get a
/// processor each.
constexpr std::chrono::microseconds kAtOnce{50};
constexpr int kCrowdedWaits = 16;
std::atomic<int> crowded_waits{0};
bool others_want_to_run() {
    if (const int left = crowded_waits.load(std::memory_order_relaxed); left > 0) {
        crowded_waits.store(left - 1, std::memory_order_relaxed);
        return true;
    }
    const auto before = std::chrono::steady_clock::now();
    std::this_thread::yield();
    if (std::chrono::steady_clock::now() - before <= kAtOnce) return false;
    crowded_waits.store(kCrowdedWaits, std::memory_order_relaxed);
    return true;
}

/// Until a number is no longer what was seen. Who changes it for good notifies.
template <class Number>
void wait_for_change(const std::atomic<Number>& number, Number seen) {
    for (int spins = 0; number == seen; ++spins)
        if (spins > kSpins && others_want_to_run()) number.wait(seen);
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
    while (const std::uint32_t running = running_) wait_for_change(running_, running);
}

void Workers::barrier() {
    if (count_ == 1) return;
    const std::uint64_t passed = barriers_;
    if (++arrived_ == count_) {
        arrived_ = 0;
        ++barriers_;
        barriers_.notify_all();
    } else {
        wait_for_change(barriers_, passed);
    }
}

void Workers::wait_for_tasks(std::uint32_t worker) {
    for (std::uint64_t seen = 0;;) {
        for (int spins = 0, idle = 0; round_ == seen;) {
            if (awake_) {
                idle = 0;
                if (++spins > kSpins && others_want_to_run()) round_.wait(seen);
            } else if (++idle > kIdleSpins) {
                round_.wait(seen);
            }
        }
        ++seen;
        if (stop_) return;
        call_(context_, worker);
        if (--running_ == 0) running_.notify_one();
    }
}

}  // namespace plumb
