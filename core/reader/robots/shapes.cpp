// SPDX-License-Identifier: MIT
#include "reader/robots/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <system_error>

#include "geometry/bad_shape.h"
#include "geometry/decompose.h"
#include "reader/meshes/obj.h"
#include "reader/meshes/stl.h"
#include "reader/shapes/polyhedra.h"
#include "scene/build.h"

namespace plumb::reader {

namespace {

namespace fs = std::filesystem;

/// A mesh that cannot be had: missing, or of a format that is not read.
class NoMesh : public BadRobot {
    using BadRobot::BadRobot;
};

void check_size(double value, const char* what) {
    if (!(value >= kLength.low && value <= kLength.high))
        throw BadRobot(std::string(what) + " must be " + in_words(kLength, "a number"));
}

/// Throws unless a link may have such a shape.
void check_shape(const Geometry& g) {
    switch (g.kind) {
        case ShapeKind::sphere:
            return check_size(g.radius, "the radius of a sphere");
        case ShapeKind::box:
            for (int i = 0; i < 3; ++i) check_size(g.half_extents[i], "half the size of a box");
            return;
        case ShapeKind::cylinder:
            check_size(g.radius, "the radius of a cylinder");
            return check_size(g.half_height, "half the length of a cylinder");
        case ShapeKind::hull:
            return;
        default:
            throw BadRobot(
                "its shapes may be spheres, boxes, cylinders, hulls and files of meshes");
    }
}

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

/// "package://NAME/PATH" is looked for as NAME/PATH and as PATH in the folder and all above it.
std::optional<fs::path> in_package(const std::string& name_and_path, const fs::path& folder) {
    const std::string path =
        name_and_path.substr(std::min(name_and_path.find('/'), name_and_path.size() - 1) + 1);
    std::error_code error;
    for (fs::path above = fs::absolute(folder, error).lexically_normal();;
         above = above.parent_path()) {
        for (const std::string& candidate : {name_and_path, path}) {
            if (is_file(above / candidate)) return above / candidate;
        }
        if (above == above.parent_path()) return std::nullopt;
    }
}

fs::path mesh_file(const std::string& uri, const fs::path& folder) {
    std::optional<fs::path> found;
    const std::size_t scheme = uri.find("://");
    const std::string rest = scheme == std::string::npos ? uri : uri.substr(scheme + 3);
    if (scheme == std::string::npos || uri.starts_with("file://")) {
        std::error_code error;
        if (fs::is_directory(folder / rest, error))
            throw NoMesh("the mesh file \"" + uri + "\" in \"" + folder.string() +
                         "\" is a folder; name a file in it");
        if (is_file(folder / rest)) found = folder / rest;
    } else if (!rest.empty()) {
        found = in_package(rest, folder);
    }
    if (!found)
        throw NoMesh("there is no mesh file \"" + uri + "\" in \"" + folder.string() + "\"" +
                     (scheme == std::string::npos ? "" : " or above"));
    return *found;
}

TriangleMesh load_mesh(const fs::path& file, const std::string& uri) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".obj") return load_obj(file);
    if (ending == ".stl") return load_stl(file);
    throw NoMesh("the mesh file \"" + uri + "\" is neither .obj nor .stl, which can be read");
}

/// The mesh as its file has it, scaled. A mirrored one is turned inside out again.
Geometry triangles(const RobotMesh& mesh, const fs::path& folder) {
    TriangleMesh loaded = load_mesh(mesh_file(mesh.uri, folder), mesh.uri);
    const Eigen::Vector3d& scale = mesh.scale;
    if (!(scale.cwiseAbs().minCoeff() >= kScale.low && scale.cwiseAbs().maxCoeff() <= kScale.high))
        throw BadRobot("the scale of the mesh \"" + mesh.uri + "\" is 0, or far from 1");
    for (Eigen::Vector3d& p : loaded.vertices) {
        p = p.cwiseProduct(scale);
        if (!(p.cwiseAbs().maxCoeff() <= kLength.high))
            throw BadRobot("a vertex of the mesh \"" + mesh.uri + "\" is too far away");
    }
    if (scale.prod() < 0) {
        for (auto& t : loaded.triangles) std::swap(t[1], t[2]);
    }
    Geometry g;
    g.kind = ShapeKind::mesh;
    g.vertices = std::move(loaded.vertices);
    g.triangles = std::move(loaded.triangles);
    return g;
}

Geometry mesh_shape(const RobotMesh& mesh, bool moves, const CollisionOptions& options) {
    Geometry g = triangles(mesh, options.folder);
    if (!moves) return g;
    try {
        return options.decompose ? decomposed(g, {}) : hull_geometry(g.vertices);
    } catch (const BadShape& error) {
        throw BadRobot("the mesh \"" + mesh.uri + "\": " + error.what());
    }
}

GeometryPart part(const RobotShape& shape, bool moves, const CollisionOptions& options) {
    const auto* mesh = std::get_if<RobotMesh>(&shape.geometry);
    if (!mesh) check_shape(std::get<Geometry>(shape.geometry));
    return {mesh ? mesh_shape(*mesh, moves, options) : std::get<Geometry>(shape.geometry),
            shape.placement};
}

double lowest(const std::vector<Eigen::Vector3d>& points, const Placement& place) {
    double y = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& p : points) y = std::min(y, (place.rotation * p).y());
    return place.position.y() + y;
}

}  // namespace

std::vector<GeometryPart> collision_parts(const LinkGroup& group, bool moves,
                                          const CollisionOptions& options,
                                          std::vector<std::string>& remarks) {
    std::vector<GeometryPart> parts;
    const auto add = [&](GeometryPart part, const Placement& in_group) {
        part.local = in_group * part.local;
        parts.push_back(std::move(part));
    };
    for (const auto& [link, in_group] : group.links) {
        for (const RobotShape& shape : link->shapes) {
            const std::string about = link_named(link->name) + ": ";
            try {
                GeometryPart whole = part(shape, moves, options);
                if (whole.geometry.kind == ShapeKind::compound) {
                    for (GeometryPart& hull : whole.geometry.parts)
                        add(std::move(hull), in_group * whole.local);
                } else {
                    add(std::move(whole), in_group);
                }
            } catch (const NoMesh& missing) {
                if (options.meshes_required)
                    throw BadRobot(
                        about + missing.what() +
                        "; \"meshes\": \"optional\" in a scene's \"robots\" leaves it out");
                remarks.push_back(about + missing.what() + ", so it is left out");
            } catch (const BadRobot& error) {
                throw BadRobot(about + error.what());
            } catch (const BadShape& error) {
                throw BadRobot(about + error.what());
            }
        }
    }
    return parts;
}

double lowest_point(const Geometry& g, const Placement& place) {
    const Eigen::Matrix3d r = place.rotation.toRotationMatrix();
    const double y = place.position.y();
    switch (g.kind) {
        case ShapeKind::sphere:
            return y - g.radius;
        case ShapeKind::box:
            return y - r.row(1).cwiseAbs().dot(g.half_extents);
        case ShapeKind::cylinder:
            return y - std::abs(r(1, 1)) * g.half_height - std::hypot(r(1, 0), r(1, 2)) * g.radius;
        case ShapeKind::hull:
        case ShapeKind::mesh:
            return lowest(g.vertices, place);
        case ShapeKind::compound: {
            double least = std::numeric_limits<double>::infinity();
            for (const GeometryPart& part : g.parts)
                least = std::min(least, lowest_point(part.geometry, place * part.local));
            return least;
        }
        default:  // no shape of a link
            return std::numeric_limits<double>::infinity();
    }
}

}  // namespace plumb::reader
