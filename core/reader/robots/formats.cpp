// SPDX-License-Identifier: MIT
#include "reader/robots/formats.h"

#include "reader/robots/urdf.h"
#include "scene/error.h"

#include <algorithm>

namespace plumb::reader {
namespace {

struct Format {
    const char* ending;
    RobotDescription (*load)(const std::filesystem::path& file);
};

/// The first is that of all other files.
constexpr Format kFormats[] = {
    {".urdf", load_urdf},
};

const Format* format_of(const std::filesystem::path& file) {
    const auto* found =
        std::find_if(std::begin(kFormats), std::end(kFormats),
                     [&](const Format& format) { return file.extension() == format.ending; });
    return found == std::end(kFormats) ? nullptr : found;
}

}  // namespace

bool is_robot(const std::filesystem::path& file) { return format_of(file) != nullptr; }

RobotDescription load_robot(const std::filesystem::path& file) {
    const Format* format = format_of(file);
    try {
        return (format ? format : kFormats)->load(file);
    } catch (const BadRobot& error) {
        throw SceneError(file.string(), "", error.what());
    }
}

}  // namespace plumb::reader
