// SPDX-License-Identifier: MIT
/// What all pages have in common: one file that opens from disk, a script, and no network.
#pragma once

#include <string>
#include <string_view>

namespace plumb {

/// From the document's type to the opened body; `title` is any text.
std::string page_head(std::string_view title);

/// An element that carries data for the script under an id. JSON must have no "<" in it.
std::string data_element(std::string_view id, std::string_view type, std::string_view content);

/// JSON text that cannot end the element it stands in, nor open a comment.
std::string without_tags(std::string_view json);

/// The script that draws the page, and the end of the document.
std::string page_end(std::string_view script);

/// The same with the player.
std::string page_end();

}  // namespace plumb
