// SPDX-License-Identifier: MIT
#include "app/progress.h"

#include <unistd.h>

#include <cstdio>

namespace plumb::app {
namespace {

constexpr int kBarWidth = 24;

std::string bar(double share) {
    std::string text = "[";
    for (int i = 0; i < kBarWidth; ++i) text += i < share * kBarWidth ? '#' : '.';
    return text + "]";
}

}  // namespace

Progress::Progress(std::uint64_t steps, bool quiet)
    : steps_(steps), on_(!quiet && isatty(STDERR_FILENO)) {}

Progress::~Progress() {
    if (drawn_) std::fputc('\n', stderr);
}

void Progress::show(std::uint64_t step, std::uint32_t contacts, const std::string& violation) {
    if (!on_) return;
    const Clock::time_point now = Clock::now();
    if (step < steps_ && now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double rate = elapsed > 0 ? static_cast<double>(step) / elapsed : 0;
    const double left = rate > 0 ? static_cast<double>(steps_ - step) / rate : 0;
    std::fprintf(stderr, "\r%s %3.0f%%  %.0f steps/s  %.0f s left  %u contacts  worst %s\033[K",
                 bar(static_cast<double>(step) / static_cast<double>(steps_)).c_str(),
                 100.0 * static_cast<double>(step) / static_cast<double>(steps_), rate, left,
                 contacts, violation.c_str());
    std::fflush(stderr);
    drawn_ = true;
}

}  // namespace plumb::app
