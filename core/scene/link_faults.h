// SPDX-License-Identifier: MIT
/// What is wrong with a link or an attachment of a scene, in a sentence. Whoever takes them asks
/// here, files and programs alike.
#pragma once

#include "scene/element_faults.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace plumb {

/// The greatest compliance and damping of links and attachments [m/N], [N s/m].
inline constexpr double kGreatestLinkStrength = 1e15;

/// A rod between points nearer than this has no direction [m].
inline constexpr double kShortestLink = 1e-9;

namespace link_faults {

inline bool is_strength(double value) { return value >= 0 && value <= kGreatestLinkStrength; }

/// `number` is of a point of the deformable.
inline std::optional<std::string> no_such_point(const Scene& scene, std::uint32_t deformable,
                                                std::uint32_t number) {
    const std::size_t count = scene.deformables[deformable].points.size();
    if (number < count) return std::nullopt;
    return "there is no point " + std::to_string(number) + "; \"" +
           scene.deformables[deformable].name + "\" has " + std::to_string(count) +
           ", numbered from 0";
}

inline std::optional<DeformableFault> end_fault(const Scene& scene, const ScenePoint& end,
                                                const std::string& place) {
    if (end.deformable != kNoIndex && end.body != kNoIndex)
        return DeformableFault{place, "must be on either a deformable or a body"};
    if (end.body != kNoIndex && end.body >= scene.bodies.size())
        return DeformableFault{place + "/body",
                               "there is no body number " + std::to_string(end.body)};
    if (end.deformable == kNoIndex) {
        if (end.position.allFinite() &&
            end.position.cwiseAbs().maxCoeff() <= deformable_faults::kFurthest)
            return std::nullopt;
        return DeformableFault{place + "/position", "must be finite numbers within ±1e9"};
    }
    if (end.deformable >= scene.deformables.size())
        return DeformableFault{place + "/deformable",
                               "there is no deformable number " + std::to_string(end.deformable)};
    if (const auto sentence = no_such_point(scene, end.deformable, end.point))
        return DeformableFault{place + "/point", *sentence};
    return std::nullopt;
}

inline std::optional<DeformableFault> length_fault(const LinkSpec& link, double apart) {
    const double shortest = link.shortest.value_or(0), longest = link.longest.value_or(shortest);
    const bool rod = link.shortest && link.longest && shortest == longest;
    if (!(shortest >= 0 && longest >= 0 && longest <= deformable_faults::kFurthest))
        return DeformableFault{rod ? "/length" : "/limits", "lengths must be from 0 to 1e9"};
    if (shortest > longest)
        return DeformableFault{"/limits", "the shortest length is above the longest"};
    if (rod && longest < kShortestLink)
        return DeformableFault{"/length",
                               "a rod without a length has no direction; \"attach\" the one point "
                               "to the other's body"};
    if (!link.shortest && !link.longest && apart < kShortestLink)
        return DeformableFault{"",
                               "its two points lie at one place, so that it has no length; give "
                               "\"length\" or \"limits\""};
    return std::nullopt;
}

}  // namespace link_faults

/// Where a point of a scene is at the start; it must be there [m].
inline Eigen::Vector3d position_of(const Scene& scene, const ScenePoint& point) {
    if (point.deformable == kNoIndex) return point.position;
    return scene.deformables[point.deformable].points[point.point];
}

/// The first fault of a link, at a place of it ("/a/point").
inline std::optional<DeformableFault> link_fault(const Scene& scene, const LinkSpec& link) {
    using namespace link_faults;
    if (auto fault = end_fault(scene, link.a, "/a")) return fault;
    if (auto fault = end_fault(scene, link.b, "/b")) return fault;
    const auto &a = link.a, &b = link.b;
    const bool loose = a.deformable != kNoIndex || b.deformable != kNoIndex;
    if (!loose && a.body == b.body)
        return DeformableFault{"", a.body == kNoIndex ? "both of its points are of the world"
                                                      : "both of its points are of one body"};
    if (loose && a.deformable == b.deformable && a.point == b.point)
        return DeformableFault{"", "it links a point to itself"};
    if (!is_strength(link.compliance))
        return DeformableFault{"/compliance", "must be from 0 to 1e15"};
    if (!is_strength(link.damping)) return DeformableFault{"/damping", "must be from 0 to 1e15"};
    return length_fault(link, (position_of(scene, a) - position_of(scene, b)).norm());
}

/// The first fault of an attachment, at a place of it ("/points/3").
inline std::optional<DeformableFault> attachment_fault(const Scene& scene,
                                                       const AttachmentSpec& spec) {
    if (spec.deformable >= scene.deformables.size())
        return DeformableFault{"/deformable",
                               "there is no deformable number " + std::to_string(spec.deformable)};
    if (spec.body != kNoIndex && spec.body >= scene.bodies.size())
        return DeformableFault{"/to", "there is no body number " + std::to_string(spec.body)};
    if (spec.points.empty()) return DeformableFault{"/points", "there are no points to attach"};
    std::vector<bool> seen(scene.deformables[spec.deformable].points.size(), false);
    for (std::size_t i = 0; i < spec.points.size(); ++i) {
        const std::string place = "/points/" + std::to_string(i);
        if (const auto said = link_faults::no_such_point(scene, spec.deformable, spec.points[i]))
            return DeformableFault{place, *said};
        if (seen[spec.points[i]])
            return DeformableFault{
                place, "point " + std::to_string(spec.points[i]) + " stands in the list twice"};
        seen[spec.points[i]] = true;
    }
    if (!link_faults::is_strength(spec.compliance))
        return DeformableFault{"/compliance", "must be from 0 to 1e15"};
    return std::nullopt;
}

}  // namespace plumb
