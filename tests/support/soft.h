// SPDX-License-Identifier: MIT
/// Deformables and links in a line each.
#pragma once

#include "reader/build_deformables.h"
#include "scene/scene.h"

namespace plumb::test {

using reader::add_soft;
using reader::balloon;
using reader::block;
using reader::hold;
using reader::rope;
using reader::sheet;
using reader::soft;

inline ScenePoint point_of(std::uint32_t deformable, std::uint32_t point) {
    ScenePoint p;
    p.deformable = deformable, p.point = point;
    return p;
}
inline ScenePoint on_body(std::uint32_t body, const Eigen::Vector3d& at) {
    ScenePoint p;
    p.body = body, p.position = at;
    return p;
}
inline ScenePoint in_the_world(const Eigen::Vector3d& at) { return on_body(kNoIndex, at); }

/// Adds a link and returns it; without lengths it is a rod.
inline LinkSpec& add_link(Scene& scene, const ScenePoint& a, const ScenePoint& b) {
    LinkSpec link;
    link.a = a, link.b = b;
    scene.links.push_back(link);
    return scene.links.back();
}

}  // namespace plumb::test
