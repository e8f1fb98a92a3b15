// SPDX-License-Identifier: MIT
#include "app/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace plumb::app {
namespace {

constexpr int kNarrowestBar = 5, kWidestBar = 24;

std::string bar(double share, int width) {
    std::string text = "[";
    for (int i = 0; i < width; ++i) text += i < share * width ? '#' : '.';
    return text + "]";
}

/// "42 s", "3:05 min", "2:10 h".
std::string duration_text(double seconds) {
    char text[40];
    const auto whole = static_cast<long long>(seconds < 1e15 ? seconds : 1e15);
    if (whole < 100)
        std::snprintf(text, sizeof text, "%lld s", whole);
    else if (whole < 6000)
        std::snprintf(text, sizeof text, "%lld:%02lld min", whole / 60, whole % 60);
    else
        std::snprintf(text, sizeof text, "%lld:%02lld h", whole / 3600, whole / 60 % 60);
    return text;
}

/// A line that is wider than the terminal would wrap, and never be drawn over.
int terminal_width() {
    winsize size{};
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80;
}

}  // namespace

Progress::Progress(std::uint64_t steps, bool quiet)
    : steps_(steps), on_(!quiet && isatty(STDERR_FILENO)) {}

void Progress::end(const std::string& what_follows) {
    if (!on_) return;
    std::fprintf(stderr, "%splumb: %s\n", drawn_ ? "\n" : "", what_follows.c_str());
    drawn_ = false;
}

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
    const double share = static_cast<double>(step) / static_cast<double>(steps_);
    char text[200];
    std::snprintf(text, sizeof text, " %3.0f%%, %.0f steps/s, %s left, %u contacts, %s",
                  100 * share, rate, duration_text(left).c_str(), contacts, violation.c_str());
    const int width = terminal_width() - 1;
    const int room = width - static_cast<int>(std::strlen(text)) - 2;
    const std::string line = bar(share, std::clamp(room, kNarrowestBar, kWidestBar)) + text;
    std::fprintf(stderr, "\r%.*s\033[K", width, line.c_str());
    std::fflush(stderr);
    drawn_ = true;
}

}  // namespace plumb::app
