// SPDX-License-Identifier: MIT
/// The whole text of a file.
#pragma once

#include <filesystem>
#include <string>

namespace plumb::reader {

/// Throws SceneError, which names the file, where it is not there or cannot be read.
std::string text_of_file(const std::filesystem::path& file);

/// Throws BadShape instead.
std::string text_of_mesh(const std::filesystem::path& file);

}  // namespace plumb::reader
