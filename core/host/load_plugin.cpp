// SPDX-License-Identifier: MIT
#include "host/load_plugin.h"

#include "host/cut_short.h"
#include "host/exception_text.h"

#include <dlfcn.h>

#include <cstring>
#include <string_view>

namespace plumb {
namespace {

constexpr const char* kFilePrefix = "plumb_collider_";

/// Why a file must not be handed to the loader, or nothing. A pipe would keep it waiting.
std::string refusal_of_file(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        return "it is not a regular file";
    const std::string lacking = cut_short(file);
    return lacking.empty() ? "" : "it cannot be loaded: " + lacking;
}

/// Why the first words of a table cannot be trusted, or nothing. The rest of it may not even be
/// there.
std::string refusal_of_version(const PluginTable& t) {
    if (t.magic != kPluginMagic) return "its table does not begin with Plumb's magic number";
    if (t.abi_major != kAbiMajor)
        return "it was built for version " + std::to_string(t.abi_major) +
               " of the plugin interface, and this is version " + std::to_string(kAbiMajor) +
               "; rebuild it against the installed headers";
    if (t.table_size < sizeof(PluginTable))
        return "its table is smaller than this version's; rebuild it";
    const AbiSizes mine = abi_sizes();
    if (std::memcmp(&t.sizes, &mine, sizeof mine) != 0)
        return "its structs have other sizes than this host's; rebuild it against the installed "
               "headers";
    return {};
}

/// Why a table of this version cannot be used, or nothing.
std::string refusal_of_contents(const PluginTable& t) {
    if (!t.name || !*t.name) return "its table has no name";
    if (!t.create || !t.destroy) return "its table lacks the function that makes or destroys";
    if (!t.description || !t.backend_version || !t.precision)
        return "its table lacks a description, a version or a precision";
    const std::string_view precision = t.precision;
    if (precision != "single" && precision != "double")
        return "its precision is \"" + std::string(precision) +
               "\", where \"single\" and \"double\" are allowed";
    return {};
}

/// The table of a loaded library, or nullptr and the reason.
const PluginTable* table_of(void* library, std::string& refusal) {
    const auto entry = reinterpret_cast<PluginEntry>(dlsym(library, kPluginSymbol));
    if (!entry) {
        refusal = std::string("it does not export ") + kPluginSymbol;
        return nullptr;
    }
    const PluginTable* table = nullptr;
    try {
        table = entry();
    } catch (...) {
        refusal = std::string(kPluginSymbol) + " threw: " + exception_text();
        return nullptr;
    }
    if (!table) refusal = std::string(kPluginSymbol) + " returned no table";
    return table;
}

}  // namespace

std::string plugin_name_of(const std::filesystem::path& file) {
    const std::string stem = file.stem().string();
    return stem.rfind(kFilePrefix, 0) == 0 ? stem.substr(std::strlen(kFilePrefix)) : stem;
}

bool is_plugin_file(const std::filesystem::path& file) {
    return file.extension() == ".so" && file.filename().string().rfind(kFilePrefix, 0) == 0;
}

ColliderInfo load_plugin(const std::filesystem::path& file) {
    ColliderInfo info{file, nullptr, plugin_name_of(file), {}};
    info.refusal = refusal_of_file(file);
    if (!info.refusal.empty()) return info;
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        const char* why = dlerror();
        info.refusal = std::string("it cannot be loaded: ") + (why ? why : "no reason given");
        return info;
    }
    const PluginTable* table = table_of(library, info.refusal);
    if (table) info.refusal = refusal_of_version(*table);
    if (table && info.refusal.empty()) info.refusal = refusal_of_contents(*table);
    if (!info.refusal.empty()) {
        dlclose(library);
        return info;
    }
    info.table = table;
    info.name = table->name;
    return info;
}

}  // namespace plumb
