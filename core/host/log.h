// SPDX-License-Identifier: MIT
/// Where the library's messages go (spdlog).
///
/// Warnings are what a run goes on in spite of; debug tells what was chosen, skipped and why, and
/// trace what happens in single steps. Results are no messages.
#pragma once

#include <spdlog/logger.h>

#include <memory>
#include <string>

namespace plumb {

/// The logger of all messages. Until another is set it writes "plumb: …" to stderr, warnings and
/// what is worse.
std::shared_ptr<spdlog::logger> logger();

/// Lets messages go to a logger of the program's own; none: to the first one again. Not while
/// other threads log.
void set_logger(std::shared_ptr<spdlog::logger> logger);

/// While it lives, `logger()` gives its thread one that passes errors only: for work that makes
/// many simulations which differ on purpose. Where debug or trace were asked for, nothing changes.
class ErrorsOnly {
public:
    ErrorsOnly();
    ~ErrorsOnly();
    ErrorsOnly(const ErrorsOnly&) = delete;
    ErrorsOnly& operator=(const ErrorsOnly&) = delete;

private:
    std::shared_ptr<spdlog::logger> before_;
};

}  // namespace plumb
