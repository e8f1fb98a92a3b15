// SPDX-License-Identifier: MIT
/// Files of triangles or tetrahedra, by the ending of their names.
#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "geometry/bad_shape.h"
#include "reader/deformables/deformables.h"
#include "reader/meshes/tet_meshes.h"
#include "scene/coincident_points.h"
#include "scene/deformable_faults.h"

namespace plumb::reader {

namespace {

Elements load(const std::filesystem::path& file, DeformableKind kind) {
    const std::string ending = file.extension().string();
    if (ending == ".obj") {
        if (kind == DeformableKind::solid)
            throw BadShape(
                "an OBJ file has no tetrahedra; a solid of its inside is {\"lattice\": {\"mesh\": "
                "…, \"cell\": …}}, and .msh and .node files have tetrahedra");
        const TriangleMesh mesh = load_obj(file);
        return {mesh.vertices, {}, mesh.triangles, {}};
    }
    const bool solid = kind == DeformableKind::solid;
    if (ending == ".msh") return load_gmsh(file, solid);
    if (ending != ".node") throw BadShape("the name of a mesh file ends in .obj, .msh or .node");
    if (!solid) throw BadShape("a .node file has tetrahedra, which only a solid is made of");
    return load_tetgen(file);
}

/// Gives points at one place one number; what has no extent then is left out. The number of
/// points that are no more.
std::size_t merge(Elements& elements) {
    auto& points = elements.points;
    const auto first = first_at_place(points, kSamePlace * size_of(points));
    std::vector<std::uint32_t> number(points.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (first[i] == i)
            points[kept] = points[i], number[i] = static_cast<std::uint32_t>(kept++);
        else
            number[i] = number[first[i]];
    }
    const std::size_t merged = points.size() - kept;
    if (merged == 0) return 0;
    points.resize(kept);
    const auto renumber = [&](auto& list) {
        for (auto& element : list)
            for (std::uint32_t& p : element) p = number[p];
        std::erase_if(list, [](const auto& element) {
            return std::set<std::uint32_t>(element.begin(), element.end()).size() < element.size();
        });
    };
    renumber(elements.triangles);
    renumber(elements.tetrahedra);
    return merged;
}

/// Turns tetrahedra of negative volume over. Programs do not agree on the order of a tetrahedron's
/// points, so that it means nothing where all have the same. Returns those that differ from most.
std::vector<std::size_t> orient(Elements& elements) {
    std::vector<std::size_t> negative, positive;
    for (std::size_t i = 0; i < elements.tetrahedra.size(); ++i) {
        auto& t = elements.tetrahedra[i];
        const double extent = deformable_faults::relative_extent(elements.points, t);
        if (extent < 0) std::swap(t[0], t[1]);
        (extent < 0 ? negative : positive).push_back(i);
    }
    return negative.size() <= positive.size() ? negative : positive;
}

}  // namespace

FileElements read_elements_file(const Node& name, double scale, DeformableKind kind) {
    const std::string file = Text{}.read(name);
    if (kind == DeformableKind::rope)
        name.fail("a rope cannot be read from a file; list its \"points\" and \"segments\"");
    try {
        FileElements read{load(name.source().folder / file, kind), 0, {}};
        for (Eigen::Vector3d& p : read.elements.points) {
            p *= scale;
            if (!(p.cwiseAbs().maxCoeff() <= 1e6))
                name.fail("a point of the file lies further away than 1e6 m");
        }
        read.merged = merge(read.elements);
        read.inverted = orient(read.elements);
        return read;
    } catch (const BadShape& error) {
        name.fail(error.what());
    }
}

}  // namespace plumb::reader
