// SPDX-License-Identifier: MIT
#include "bullet/load_backend.h"

#include <dlfcn.h>
#include <link.h>

#include <filesystem>
#include <string_view>

namespace plumb::bullet {
namespace {

#ifdef PLUMB_BULLET_SINGLE
constexpr const char* kName = "bullet_float";
constexpr const char* kOther = "double";
constexpr const char* kFile = "plumb_bullet_float.so";
constexpr bool kOtherIsDouble = true;
#else
constexpr const char* kName = "bullet";
constexpr const char* kOther = "single";
constexpr const char* kFile = "plumb_bullet.so";
constexpr bool kOtherIsDouble = false;
#endif

/// Whether a loaded library is Bullet in the other precision: Debian marks double by a suffix.
bool is_other(std::string_view path) {
    const std::string_view file = path.substr(path.rfind('/') + 1);
    for (std::string_view library : {"libLinearMath", "libBulletCollision"}) {
        if (file.substr(0, library.size()) != library) continue;
        const bool is_double = file.substr(library.size(), 8) == "-float64";
        return is_double == kOtherIsDouble;
    }
    return false;
}

/// File of the other precision in this process; "" where there is none.
std::string loaded_other() {
    std::string found;
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* to) {
            if (!info->dlpi_name || !is_other(info->dlpi_name)) return 0;
            *static_cast<std::string*>(to) = info->dlpi_name;
            return 1;
        },
        &found);
    return found;
}

/// The folder of backends, beside that of the plugins.
std::filesystem::path backend_file() {
    Dl_info info{};
    dladdr(reinterpret_cast<const void*>(&backend_file), &info);
    std::error_code ignored;
    const auto self = std::filesystem::canonical(info.dli_fname ? info.dli_fname : "", ignored);
    return self.parent_path().parent_path() / "backends" / kFile;
}

Backend loaded() {
    const std::string other = loaded_other();
    if (!other.empty())
        return {nullptr, nullptr,
                std::string(kName) + " cannot be used in a process that has loaded Bullet in " +
                    kOther + " precision (" + other + "); run it in a process of its own"};
    void* library = dlopen(backend_file().c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return {nullptr, nullptr, std::string("its backend cannot be loaded: ") + dlerror()};
    const auto create =
        reinterpret_cast<decltype(&plumb_bullet_create)>(dlsym(library, "plumb_bullet_create"));
    const auto destroy =
        reinterpret_cast<decltype(&plumb_bullet_destroy)>(dlsym(library, "plumb_bullet_destroy"));
    if (create && destroy) return {create, destroy, {}};
    return {nullptr, nullptr, "its backend " + backend_file().string() + " is of another version"};
}

}  // namespace

const Backend& load_backend() {
    static const Backend backend = loaded();
    return backend;
}

}  // namespace plumb::bullet
