// SPDX-License-Identifier: MIT
/// The script of the page of a study, as it stands in charts/dist/charts.min.js.
#pragma once

#include <string_view>

namespace plumb {

std::string_view charts_script();

}  // namespace plumb
