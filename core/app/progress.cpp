// SPDX-License-Identifier: MIT
#include "app/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

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

bool Progress::is_due(bool last) {
    if (!on_) return false;
    const Clock::time_point now = Clock::now();
    if (!last && now - last_ < std::chrono::milliseconds(100)) return false;
    last_ = now;
    return true;
}

double Progress::seconds_left(double share) const {
    const double elapsed = std::chrono::duration<double>(last_ - start_).count();
    return share > 0 ? elapsed / share - elapsed : 0;
}

void Progress::draw(double share, const std::string& text) {
    const int width = terminal_width() - 1;
    const int room = width - static_cast<int>(text.size()) - 2;
    const std::string line = bar(share, std::clamp(room, kNarrowestBar, kWidestBar)) + text;
    std::fprintf(stderr, "\r%.*s\033[K", width, line.c_str());
    std::fflush(stderr);
    drawn_ = true;
}

void Progress::show(std::uint64_t step, std::uint32_t contacts, const std::string& violation) {
    if (!is_due(step >= steps_)) return;
    const double share = static_cast<double>(step) / static_cast<double>(steps_);
    const double elapsed = std::chrono::duration<double>(last_ - start_).count();
    const double rate = elapsed > 0 ? static_cast<double>(step) / elapsed : 0;
    char text[200];
    std::snprintf(text, sizeof text, " %3.0f%%, %.0f steps/s, %s left, %u contacts, %s",
                  100 * share, rate, duration_text(seconds_left(share)).c_str(), contacts,
                  violation.c_str());
    draw(share, text);
}

void Progress::show_runs(std::uint64_t done, std::uint64_t all, const std::string& what) {
    if (!is_due(done >= all)) return;
    const double share = all > 0 ? static_cast<double>(done) / static_cast<double>(all) : 1;
    char text[200];
    std::snprintf(text, sizeof text, " %3.0f%%, %llu of %llu runs, %s left, %s", 100 * share,
                  static_cast<unsigned long long>(done), static_cast<unsigned long long>(all),
                  duration_text(seconds_left(share)).c_str(), what.c_str());
    draw(share, text);
}

}  // namespace plumb::app
