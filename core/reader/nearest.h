// SPDX-License-Identifier: MIT
/// The nearest spelling of a name that is unknown.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumb::reader {

/// Edits (insert, delete, replace, swap of two neighbours) that turn one word into the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate that `word` most likely stands for, or "" when none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// What an error says of an unknown word: `; did you mean "friction"? Allowed: density, friction`.
std::string advice(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace plumb::reader
