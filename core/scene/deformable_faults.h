// SPDX-License-Identifier: MIT
/// What is wrong with a deformable by its own numbers, in a sentence that names the element.
/// Whoever takes deformables asks here, files and programs alike.
#pragma once

#include "scene/deformable.h"
#include "scene/element_faults.h"
#include "scene/surface_faults.h"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>

namespace plumb {

/// What numbers of a deformable are allowed, both ends included.
struct DeformableBounds {
    double low, high;
};
inline constexpr DeformableBounds kThicknessBounds{1e-6, 1e6};         ///< [m]
inline constexpr DeformableBounds kYoungBounds{1e-6, 1e15};            ///< [Pa]
inline constexpr DeformableBounds kStrainDampingBounds{0, 1e9};        ///< [s]
inline constexpr DeformableBounds kBendingBounds{0, 1e15};             ///< [N m], [N m²]
inline constexpr DeformableBounds kVolumeRatioBounds{1e-3, 1e3};       ///< [1]
inline constexpr DeformableBounds kPressureBounds{-1e12, 1e12};        ///< [Pa]
inline constexpr DeformableBounds kDragBounds{0, 1e6};                 ///< [1]
inline constexpr DeformableBounds kParticleRadiusBounds{1e-6, 1e6};    ///< [m]
inline constexpr DeformableBounds kDeformableMassBounds{1e-12, 1e15};  ///< [kg]
inline constexpr double kLeastTearingStrain = 1e-6;

inline const char* name_of(DeformableKind kind) {
    switch (kind) {
        case DeformableKind::rope:
            return "rope";
        case DeformableKind::cloth:
            return "cloth";
        case DeformableKind::balloon:
            return "balloon";
        case DeformableKind::solid:
            return "solid";
    }
    return "deformable of no kind";
}

namespace deformable_faults {

inline std::optional<DeformableFault> bounds_fault(const char* place, double value,
                                                   const DeformableBounds& bounds) {
    if (value >= bounds.low && value <= bounds.high) return std::nullopt;
    char text[80];
    std::snprintf(text, sizeof text, "must be from %g to %g, but is %g", bounds.low, bounds.high,
                  value);
    return DeformableFault{place, text};
}

inline std::optional<DeformableFault> poisson_fault(const DeformableSpec& spec) {
    const double ratio = spec.elasticity.poissons_ratio;
    const bool solid = spec.kind == DeformableKind::solid;
    if (ratio > -1 && ratio < (solid ? 0.5 : 1)) return std::nullopt;
    char text[80];
    std::snprintf(text, sizeof text, "must be above -1 and below %s, but is %g",
                  solid ? "0.5 in a solid" : "1", ratio);
    return DeformableFault{"/poisson", text};
}

inline std::optional<DeformableFault> numbers_fault(const DeformableSpec& spec,
                                                    std::size_t material_count) {
    std::optional<DeformableFault> fault;
    const auto within = [&](const char* place, double value, const DeformableBounds& bounds) {
        if (!fault) fault = bounds_fault(place, value, bounds);
    };
    within("/thickness", spec.thickness, kThicknessBounds);
    within("/young", spec.elasticity.youngs_modulus, kYoungBounds);
    within("/damping", spec.elasticity.damping, kStrainDampingBounds);
    within("/bending", spec.elasticity.bending_stiffness.value_or(0), kBendingBounds);
    within("/volume_ratio", spec.volume_ratio, kVolumeRatioBounds);
    within("/pressure", spec.pressure.value_or(0), kPressureBounds);
    within("/drag", spec.drag, kDragBounds);
    within("/skin_drag", spec.skin_drag, kDragBounds);
    within("/radius", spec.radius, kParticleRadiusBounds);
    if (spec.mass) within("/mass", *spec.mass, kDeformableMassBounds);
    if (!fault) fault = poisson_fault(spec);
    if (fault) return fault;
    if (!(spec.tearing_strain >= kLeastTearingStrain))
        return DeformableFault{"/tearing_strain",
                               "must be at least 1e-06, or infinite for what never tears"};
    if (!spec.velocity.allFinite() || spec.velocity.cwiseAbs().maxCoeff() > kFurthest)
        return DeformableFault{"/velocity", "must be finite numbers within ±1e9"};
    if (spec.material >= material_count)
        return DeformableFault{"/material",
                               "there is no material " + std::to_string(spec.material)};
    return std::nullopt;
}

/// Elements that a kind is not made of.
inline std::optional<DeformableFault> kind_fault(const DeformableSpec& spec) {
    const std::string kind = name_of(spec.kind);
    const bool sheet = spec.kind == DeformableKind::cloth || spec.kind == DeformableKind::balloon;
    const bool solid = spec.kind == DeformableKind::solid, rope = spec.kind == DeformableKind::rope;
    if (!sheet && !solid && !rope) return DeformableFault{"/kind", "there is no such kind"};
    if (!rope && !spec.segments.empty())
        return DeformableFault{"/segments", "a " + kind + " has no segments"};
    if (!sheet && !solid && !spec.triangles.empty())
        return DeformableFault{"/triangles", "a " + kind + " has no triangles"};
    if (!solid && !spec.tetrahedra.empty())
        return DeformableFault{"/tetrahedra", "a " + kind + " has no tetrahedra"};
    return std::nullopt;
}

inline std::optional<DeformableFault> elements_fault(const DeformableSpec& spec) {
    const auto& points = spec.points;
    if (auto fault = element_fault(points, spec.segments)) return fault;
    if (auto fault = element_fault(points, spec.triangles)) return fault;
    if (auto fault = element_fault(points, spec.tetrahedra)) return fault;
    if (spec.kind == DeformableKind::rope) return unused_point_fault(points, spec.segments);
    if (spec.kind == DeformableKind::solid) return unused_point_fault(points, spec.tetrahedra);
    return unused_point_fault(points, spec.triangles);
}

/// How the elements meet.
inline std::optional<DeformableFault> whole_fault(const DeformableSpec& spec) {
    if (auto fault = twin_fault(spec.points)) return fault;
    if (spec.kind == DeformableKind::rope) return std::nullopt;
    if (spec.kind == DeformableKind::solid) return face_fault(spec.tetrahedra);
    const bool closed = spec.kind == DeformableKind::balloon;
    if (auto fault = edge_fault(spec.triangles, closed)) return fault;
    if (closed) return volume_fault(spec.points, spec.triangles);
    return std::nullopt;
}

}  // namespace deformable_faults

/// The first fault of a deformable in a scene of so many materials.
inline std::optional<DeformableFault> deformable_fault(const DeformableSpec& spec,
                                                       std::size_t material_count) {
    using namespace deformable_faults;
    if (auto fault = points_fault(spec.points)) return fault;
    if (auto fault = numbers_fault(spec, material_count)) return fault;
    if (auto fault = kind_fault(spec)) return fault;
    if (auto fault = elements_fault(spec)) return fault;
    return whole_fault(spec);
}

}  // namespace plumb
