// SPDX-License-Identifier: MIT
#include "reader/meshes/file_text.h"

#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

#include "geometry/bad_shape.h"
#include "scene/error.h"

namespace plumb::reader {

namespace {

namespace fs = std::filesystem;

/// The whole text, or nothing where the file cannot be read.
std::optional<std::string> read_whole(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (stream.peek() != std::ifstream::traits_type::eof()) text << stream.rdbuf();
    if (!stream.is_open() || stream.bad()) return std::nullopt;
    return text.str();
}

}  // namespace

std::string text_of_file(const std::filesystem::path& file) {
    std::error_code error;
    if (!fs::exists(file, error)) throw SceneError(file.string(), "", "there is no such file");
    if (!fs::is_regular_file(file, error)) {
        throw SceneError(file.string(), "", "this is not a file that can be read");
    }
    const std::optional<std::string> text = read_whole(file);
    if (!text) throw SceneError(file.string(), "", "the file cannot be read");
    return *text;
}

std::string text_of_mesh(const fs::path& file) {
    const std::string name = '"' + file.string() + '"';
    std::error_code error;
    if (fs::is_directory(file, error)) {
        throw BadShape("the mesh file " + name + " is a folder; name a file in it");
    }
    if (!fs::exists(file, error)) throw BadShape("there is no mesh file " + name);
    const std::optional<std::string> text =
        fs::is_regular_file(file, error) ? read_whole(file) : std::nullopt;
    if (!text) throw BadShape("the mesh file " + name + " cannot be read");
    return *text;
}

}  // namespace plumb::reader
