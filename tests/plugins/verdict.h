// SPDX-License-Identifier: MIT
/// The suite's verdict on one plugin, for its author: the tests run in a process of their own, so
/// that a plugin which dies or hangs is reported and not suffered.
#pragma once

#include <string>

namespace plumb::test {

struct CheckOptions {
    std::string plugin;        ///< name, or path of the shared library
    std::string filter = "*";  ///< tests by name: "Filters.*"
    int limit = 60;            ///< for each test [s]
};

enum class Verdict { conforms, does_not, refused };

/// Runs the suite, prints one line a test and a sentence for each failure. A plugin that the host
/// would refuse is refused with the host's sentence, on stderr.
Verdict check_plugin(const CheckOptions& options);

}  // namespace plumb::test
