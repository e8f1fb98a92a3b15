// SPDX-License-Identifier: MIT
/// A comparison of colliders as one HTML file: its tables, and its worst disagreements drawn.
#pragma once

#include "scene/geometry.h"

#include <string>
#include <string_view>
#include <vector>

namespace plumb {

/// The page. `comparison`: the JSON of a comparison; its bodies name their shapes by index into
/// `geometries`, of which those that nothing names may be nullptr.
std::string comparison_page(const std::string& title, std::string_view comparison,
                            const std::vector<const Geometry*>& geometries);

}  // namespace plumb
