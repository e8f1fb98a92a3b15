// SPDX-License-Identifier: MIT
#include "reader/file_text.h"

#include <fstream>
#include <sstream>
#include <system_error>

#include "scene/error.h"

namespace plumb::reader {

std::string text_of_file(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error))
        throw SceneError(file.string(), "", "there is no such file");
    if (!std::filesystem::is_regular_file(file, error)) {
        throw SceneError(file.string(), "", "this is not a file that can be read");
    }
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (stream.peek() != std::ifstream::traits_type::eof()) text << stream.rdbuf();
    if (!stream.is_open() || stream.bad())
        throw SceneError(file.string(), "", "the file cannot be read");
    return text.str();
}

}  // namespace plumb::reader
