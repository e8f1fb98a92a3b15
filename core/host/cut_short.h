// SPDX-License-Identifier: MIT
/// Whether a shared library has lost its end, as a copy that was broken off has. The loader maps
/// such a file without a word, and the first touch of a page that is not there ends the process.
#pragma once

#include <filesystem>
#include <string>

namespace plumb {

/// What a file lacks of the segments that its ELF headers announce, as a sentence; "" where it has
/// them all, or where its headers are not those of a library of this machine's word size (which
/// the loader tells itself).
std::string cut_short(const std::filesystem::path& file);

}  // namespace plumb
