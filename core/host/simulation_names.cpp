// SPDX-License-Identifier: MIT
/// What things are called.
#include "host/simulation_parts.h"

#include <algorithm>

namespace plumb {
namespace {

/// The first of a list of this name.
template <class Entry, class NameOf>
std::optional<std::uint32_t> first_named(const std::vector<Entry>& list, const std::string& name,
                                         const NameOf& name_of) {
    const auto at = std::find_if(list.begin(), list.end(),
                                 [&](const Entry& entry) { return name_of(entry) == name; });
    if (at == list.end()) return std::nullopt;
    return static_cast<std::uint32_t>(at - list.begin());
}

/// The lowest identifier of this name for which `lives(id)` holds.
template <class Lives>
std::optional<std::uint32_t> first_alive(const Names& names, const std::string& name,
                                         const Lives& lives) {
    const auto [first, last] = names.equal_range(name);
    const auto at =
        std::find_if(first, last, [&](const auto& entry) { return lives(entry.second); });
    return at == last ? std::nullopt : std::optional(at->second);
}

}  // namespace

std::optional<std::uint32_t> Simulation::find_body(const std::string& name) const {
    return first_alive(parts_->body_names, name, [this](std::uint32_t id) { return has_body(id); });
}
std::optional<std::uint32_t> Simulation::find_joint(const std::string& name) const {
    return first_alive(parts_->joint_names, name,
                       [this](std::uint32_t id) { return has_joint(id); });
}
std::optional<std::uint32_t> Simulation::find_material(const std::string& name) const {
    return first_named(parts_->assets.materials, name, [](const Material& m) { return m.name; });
}
std::optional<std::uint32_t> Simulation::find_deformable(const std::string& name) const {
    return first_named(parts_->world.deformables, name,
                       [](const Deformable& d) { return d.spec.name; });
}

}  // namespace plumb
