// SPDX-License-Identifier: MIT
/// The program's verbs. A new verb is a file of its own, a line here and a line in main.cpp.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace plumb::app {

/// How the program ends.
enum ExitCode {
    kDone = 0,
    kInternalError = 1,
    kDiffer = 1,  ///< of compare: the colliders do not agree
    kUsage = 2,
    kBadScene = 3,  ///< or another file that cannot be read
    kColliderUnable = 4,
    kDiverged = 5,
    kCannotWrite = 6,
    kInterrupted = 130
};

/// Adds a verb's options to its command and returns what it does.
using Verb = std::function<int()>;
Verb add_run(CLI::App& command);
Verb add_colliders(CLI::App& command);
Verb add_effects(CLI::App& command);
Verb add_check(CLI::App& command);
Verb add_compare(CLI::App& command);
Verb add_export(CLI::App& command);
Verb add_cost(CLI::App& command);
Verb add_tune(CLI::App& command);

}  // namespace plumb::app
