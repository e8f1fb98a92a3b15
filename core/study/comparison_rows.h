// SPDX-License-Identifier: MIT
/// A comparison as rows of a table, and its disagreements as sentences: what text, JSON and page
/// have in common.
#pragma once

#include "study/comparison.h"

#include <string>
#include <vector>

namespace plumb::study {

/// One aspect of two contact sets.
struct AspectRow {
    std::string key;        ///< "pairs", "gap", "deep_gap", "normal", "deep_normal", "extent"
    std::string label;      ///< in words
    std::string tolerance;  ///< with its unit
    double wanted;          ///< share that must be within; negative: not judged
    std::uint64_t compared;
    double within;  ///< share in [0, 1]
    /// Errors; extents of convex bodies as the ratio of the smaller to the larger.
    double median, p99, worst;
    std::string unit;     ///< of the errors; empty where there are none
    std::string verdict;  ///< "agree", "DIFFER", "–" (nothing compared), "not judged"
};

std::vector<AspectRow> rows_of(const ComparisonTotals& totals, const ComparisonKind& kind,
                               bool meshes);

/// "pair", "gap", "deep gap", "normal", "deep normal", "patch".
const char* name_of(Aspect aspect);

/// Two answers that differ most, of a pair of colliders.
struct Finding {
    std::size_t first, second;  ///< indices into ComparisonResult::colliders
    bool raw;
    bool judged;  ///< whether it counts against agreement
    Disagreement disagreement;
};

/// All that were kept: the clipped ones first, then the raw ones.
std::vector<Finding> findings_of(const ComparisonResult& result);

/// "box 12" of a body, or "body 3" where it has no name.
std::string body_name(const Scene& scene, std::uint32_t body);

/// "box 0.4 × 0.4 × 0.4 m".
std::string shape_text(const Scene& scene, std::uint32_t body);

/// What differs, by how much.
std::string difference_text(const Finding& finding);

/// What one collider said of the pair: "4 points, 1.2 mm deep, normal (0.000, 1.000, 0.000)".
std::string answer_text(const std::vector<Contact>& contacts);

/// "1.23 mm"
std::string length_text(double metres);

}  // namespace plumb::study
