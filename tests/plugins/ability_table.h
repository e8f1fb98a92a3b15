// SPDX-License-Identifier: MIT
/// A table for people: what each plugin was seen to do with each pair of kinds.
#pragma once

#include <string>
#include <vector>

namespace plumb::test {

/// Prints it in Markdown. Each claimed pair of kinds goes through the tests of pairs in a process
/// of its own, plugin by plugin, so that none meets another and none takes the table down with it.
/// True when every plugin could be asked and every claim held.
bool print_ability_table(const std::vector<std::string>& plugins);

}  // namespace plumb::test
