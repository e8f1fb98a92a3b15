// SPDX-License-Identifier: MIT
/// The nearest spelling of a name that is unknown. For errors of all layers, so all of it is here.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

/// Edits (insert, delete, replace, swap of two neighbours) that turn one word into the other.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
    // Rows of the table of distances between the first i letters of a and the first j of b.
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;

    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

/// The candidate that `word` most likely stands for, or "" when none is near.
inline std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
    constexpr std::size_t kLongestCompared = 64;  // [characters]
    if (word.empty() || word.size() > kLongestCompared) return "";

    // Two fifths of the letters may be wrong, and one always.
    std::size_t best_distance = std::max<std::size_t>(1, 2 * word.size() / 5) + 1;
    std::string best;
    for (const std::string& candidate : candidates) {
        if (candidate.size() > kLongestCompared) continue;
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best_distance) {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

/// What an error says of an unknown word: `; did you mean "friction"? Allowed: density, friction`.
inline std::string advice(std::string_view word, const std::vector<std::string>& candidates) {
    const std::string near = nearest(word, candidates);
    std::string text = near.empty() ? "." : "; did you mean \"" + near + "\"?";
    if (candidates.empty()) return text;
    constexpr std::size_t kMostNamed = 24;

    text += " Allowed: ";
    for (std::size_t i = 0; i < std::min(candidates.size(), kMostNamed); ++i) {
        text += (i > 0 ? ", " : "") + candidates[i];
    }
    if (candidates.size() > kMostNamed) {
        text += " and " + std::to_string(candidates.size() - kMostNamed) + " more";
    }
    return text;
}

}  // namespace plumb
