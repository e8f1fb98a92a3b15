// SPDX-License-Identifier: MIT
/// What a collision plugin exports: one C function that returns a table of plain data.
///
/// A shared library `plumb_collider_NAME.so` defines
///
///     extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin(void);
///
/// The host loads it with RTLD_NOW | RTLD_LOCAL, and reads `magic` and the version before anything
/// else. A plugin of another major version, or whose structs have other sizes, is refused with a
/// sentence; a plugin of a lower minor version is used without what came later.
#pragma once

#include <plumb/proximity.h>

#include <cstdint>

#if defined(_WIN32)
#define PLUMB_PLUGIN_EXPORT __declspec(dllexport)
#else
#define PLUMB_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif

namespace plumb {

inline constexpr std::uint32_t kPluginMagic = 0x504c4d42u;  // "PLMB"
inline constexpr std::uint32_t kAbiMajor = 1;
inline constexpr std::uint32_t kAbiMinor = 0;
inline constexpr const char* kPluginSymbol = "plumb_collider_plugin";

/// What a collider can do with a pair of shape kinds.
enum PairAbility : std::uint32_t {
    kPairNone = 0,
    kPairPoint = 1u << 0,       ///< at least one point when overlapping
    kPairManifold = 1u << 1,    ///< a full manifold in one call
    kPairSeparated = 1u << 2,   ///< also while separated by less than the margin
    kPairThreadSafe = 1u << 3,  ///< may run on several threads at once
    kPairMovingMesh = 1u << 4   ///< a mesh of the pair may belong to a moving body
};

/// Sizes of the structs that cross the border, as the plugin was built.
struct AbiSizes {
    std::uint32_t shape, shape_part, placement, contact, sink, detect_request, detect_stats, status;
};
inline constexpr AbiSizes abi_sizes() noexcept {
    return {sizeof(Shape),       sizeof(ShapePart),     sizeof(ShapePlacement), sizeof(Contact),
            sizeof(ContactSink), sizeof(DetectRequest), sizeof(DetectStats),    sizeof(Status)};
}

/// Host's choices for a collider. `options` is a JSON object as text, or nullptr.
struct CreateRequest {
    std::uint32_t threads;   ///< workers that the host will offer
    std::uint32_t reserved;  ///< zero
    const char* options;
};

struct PluginTable {
    std::uint32_t magic;       ///< kPluginMagic
    std::uint32_t abi_major;   ///< kAbiMajor
    std::uint32_t abi_minor;   ///< kAbiMinor
    std::uint32_t table_size;  ///< sizeof(PluginTable)
    AbiSizes sizes;            ///< abi_sizes()

    const char* name;             ///< "ode": what a user writes behind --collider
    const char* description;      ///< one line
    const char* backend_version;  ///< "ODE 0.16.2"
    const char* precision;        ///< "double" or "single"

    /// PairAbility bits for each pair of kinds; symmetric.
    std::uint32_t pairs[kShapeKindCount][kShapeKindCount];

    /// What a near pair typically costs [ns], symmetric; 0: not known. Decides which collider is
    /// the cheapest for a scene. Compounds count as their parts, so their row is not read.
    std::uint32_t costs[kShapeKindCount][kShapeKindCount];

    /// Names of plugins that must not be used in one process with this one, separated by commas; or
    /// nullptr.
    const char* conflicts;

    /// Makes a collider. Returns nullptr and sets *message when it cannot.
    Proximity* (*create)(const CreateRequest* request, const char** message);
    void (*destroy)(Proximity* proximity);
};

using PluginEntry = const PluginTable* (*)();

}  // namespace plumb
