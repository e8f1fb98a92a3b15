// SPDX-License-Identifier: MIT
/// A run of the suite in a process of its own, and what it tells its parent, line by line.
#pragma once

#include "standing.h"

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace plumb::test {

/// What a line is about, its first letter.
enum Told : char {
    kTellsRefusal = 'R',  ///< why the plugin cannot be used; nothing follows
    kTellsPlugin = 'P',   ///< name, version, precision
    kTellsBegin = 'B',    ///< full name of a test
    kTellsFailure = 'F',  ///< a sentence
    kTellsSkipped = 'S',  ///< why the test does not apply
    kTellsEnd = 'E'       ///< the test has returned
};

struct Child {
    pid_t pid = -1;
    int lines = -1;  ///< file descriptor to read from
};

/// Starts the tests that `filter` names, but for those done, on one plugin. With a pair of kinds,
/// only stacks of these two are looked at; with a limit [s], the process is ended after it.
Child start_child(const std::string& plugin_file, const std::string& filter,
                  const std::vector<std::string>& done, const std::optional<KindPair>& pair = {},
                  unsigned limit = 0);

}  // namespace plumb::test
