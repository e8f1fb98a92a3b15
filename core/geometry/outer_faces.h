// SPDX-License-Identifier: MIT
/// The surface of what is made of tetrahedra: the faces that belong to one of them alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumb {

/// Counter-clockwise from outside, where each tetrahedron (a, b, c, d) is the right way round:
/// (b − a) × (c − a) · (d − a) > 0.
inline std::vector<std::array<std::uint32_t, 3>> outer_faces(
    const std::vector<std::array<std::uint32_t, 4>>& tetrahedra) {
    using Face = std::array<std::uint32_t, 3>;
    constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{
        {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
    const auto sorted = [](Face face) {
        std::sort(face.begin(), face.end());
        return face;
    };
    std::vector<Face> faces, keys;
    for (const auto& t : tetrahedra)
        for (const auto& f : kFaces) faces.push_back({t[f[0]], t[f[1]], t[f[2]]});
    for (const Face& face : faces) keys.push_back(sorted(face));
    std::sort(keys.begin(), keys.end());
    std::erase_if(faces, [&](const Face& face) {
        const auto [first, last] = std::equal_range(keys.begin(), keys.end(), sorted(face));
        return last - first != 1;
    });
    return faces;
}

}  // namespace plumb
