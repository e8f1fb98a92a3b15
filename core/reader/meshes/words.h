// SPDX-License-Identifier: MIT
/// Words and numbers of a text.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace plumb::reader {

/// Takes the next word off a text; "" at its end.
inline std::string_view next_word(std::string_view& text) {
    constexpr std::string_view blanks = " \t\r\n";
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    return word;
}

/// `std::from_chars` takes no plus.
inline std::string_view without_plus(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    return word;
}

/// What a word says, if all of it is a number of that type, with no plus before it.
template <class T>
std::optional<T> number_of(std::string_view word) {
    T value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = error == std::errc() && end == word.data() + word.size();
    return whole ? std::optional(value) : std::nullopt;
}

/// What a word says, if it is a finite number.
inline std::optional<double> finite_number(std::string_view word) {
    const std::optional<double> value = number_of<double>(without_plus(word));
    return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace plumb::reader
