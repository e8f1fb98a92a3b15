// SPDX-License-Identifier: MIT
/// A study of accuracy and cost as one HTML file: advice, work–precision charts, tables.
#pragma once

#include <string>
#include <string_view>

namespace plumb {

/// The page. `study_json`: the JSON of a study, as core/output/charts/README.md describes it; the
/// page carries it whole and draws it when it is opened.
std::string study_page(const std::string& title, std::string_view study_json);

}  // namespace plumb
