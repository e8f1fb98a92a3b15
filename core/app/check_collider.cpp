// SPDX-License-Identifier: MIT
/// plumb colliders --check: the suite is a program of its own, beside this one, because a plugin
/// may take its process down.
#include "app/check_collider.h"

#include "app/verbs.h"
#include "host/collider_library.h"
#include "scene/error.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace plumb::app {
namespace {

namespace fs = std::filesystem;

/// The file behind a name. A plugin that the host refuses is refused here too, with its sentence.
fs::path file_of(const std::string& name, const std::string& path) {
    const bool is_file = name.find('/') != std::string::npos || fs::path(name).extension() == ".so";
    if (!is_file) return ColliderLibrary(path).find(name).file;
    std::error_code ignored;
    if (!fs::exists(name, ignored)) throw ColliderError("there is no file " + name);
    return fs::absolute(name);
}

}  // namespace

int check_collider(const std::string& name_or_file, const std::string& path) {
    const fs::path file = file_of(name_or_file, path);
    std::error_code ignored;
    const fs::path suite =
        fs::canonical("/proc/self/exe", ignored).parent_path() / "plumb_check_collider";
    if (!fs::exists(suite, ignored))
        throw ColliderError("the conformance suite is not installed: " + suite.string() +
                            " is missing; build Plumb where GoogleTest is there");
    std::fflush(nullptr);
    execl(suite.c_str(), suite.c_str(), file.c_str(), static_cast<char*>(nullptr));
    throw ColliderError(suite.string() + " cannot be started: " + std::strerror(errno));
}

}  // namespace plumb::app
