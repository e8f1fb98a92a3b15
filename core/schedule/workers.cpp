// SPDX-License-Identifier: MIT
#include "schedule/workers.h"

namespace plumb {
namespace {

/// A barrier is usually a microsecond away: so often it is looked for before others may run.
constexpr int kSpins = 2000;

/// Then as often with a look at whether others want to run, some milliseconds: a worker that sleeps
/// takes longer to wake than most tasks take, so it sleeps between steps and not within one.
constexpr int kYields = 20000;

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
        for (int spins = 0; round_ == seen; ++spins) {
            if (spins > kSpins + kYields)
                round_.wait(seen);
            else if (spins > kSpins)
                std::this_thread::yield();
        }
        ++seen;
        if (stop_) return;
        call_(context_, worker);
        --running_;
    }
}

}  // namespace plumb
