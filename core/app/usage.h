// SPDX-License-Identifier: MIT
/// What is said of a command line that cannot be understood.
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>

namespace plumb::app {

/// A mistake on the command line (exit code 2).
class UsageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One sentence for what the parser refused, with the nearest spelling of an unknown verb or
/// option.
std::string usage_sentence(const CLI::App& app, int argc, char** argv, const CLI::ParseError& e);

}  // namespace plumb::app
