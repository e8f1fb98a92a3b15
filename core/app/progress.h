// SPDX-License-Identifier: MIT
/// A bar on stderr while a run goes on, where stderr is a terminal; silence elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace plumb::app {

class Progress {
public:
    Progress(std::uint64_t steps, bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Redraws at most ten times a second. `violation` is a few words about the worst one so far.
    void show(std::uint64_t step, std::uint32_t contacts, const std::string& violation);

    /// The same for work that is made of runs, of which there may become more or fewer.
    void show_runs(std::uint64_t done, std::uint64_t all, const std::string& what);

    /// Leaves the bar as it is and says what the program does next.
    void end(const std::string& what_follows);

private:
    using Clock = std::chrono::steady_clock;
    bool is_due(bool last);
    double seconds_left(double share) const;
    void draw(double share, const std::string& text);

    std::uint64_t steps_;
    bool on_, drawn_ = false;
    Clock::time_point start_ = Clock::now(), last_{};
};

}  // namespace plumb::app
