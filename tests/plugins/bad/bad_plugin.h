// SPDX-License-Identifier: MIT
/// What the plugins have in common that a host must refuse or survive: a collider that takes all
/// shapes and finds nothing, and a table in which nothing is wrong.
#pragma once

#include <plumb/plugin.h>

namespace plumb::bad {

class Nothing : public Proximity {
public:
    virtual ~Nothing() = default;
    Status add(std::uint32_t, const ShapePlacement&) noexcept override { return ok_status(); }
    Status remove(std::uint32_t) noexcept override { return ok_status(); }
    Status exclude(std::uint32_t, std::uint32_t, bool) noexcept override { return ok_status(); }
    Status detect(const DetectRequest&, const ContactSink*, std::uint32_t) noexcept override {
        return ok_status();
    }
    DetectStats stats() const noexcept override { return {}; }
};

/// A table under a name whose colliders are of the given kind.
template <class Kind>
PluginTable table_for(const char* name) {
    PluginTable t{};
    t.magic = kPluginMagic;
    t.abi_major = kAbiMajor;
    t.abi_minor = kAbiMinor;
    t.table_size = sizeof(PluginTable);
    t.sizes = abi_sizes();
    t.name = name;
    t.description = "misbehaves, for tests of the host";
    t.backend_version = "none";
    t.precision = "double";
    for (auto& row : t.pairs)
        for (auto& bits : row) bits = kPairPoint | kPairManifold | kPairSeparated;
    t.create = [](const CreateRequest*, const char**) -> Proximity* { return new Kind; };
    t.destroy = [](Proximity* proximity) { delete static_cast<Kind*>(proximity); };
    return t;
}

}  // namespace plumb::bad
