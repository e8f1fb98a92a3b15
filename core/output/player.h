// SPDX-License-Identifier: MIT
/// The script of the HTML replay, as it stands in player/dist/player.min.js.
#pragma once

#include <string_view>

namespace plumb {

std::string_view player_script();

}  // namespace plumb
