// SPDX-License-Identifier: MIT
#include "reader/meshes/obj.h"

#include <tiny_obj_loader.h>

#include <Eigen/Geometry>
#include <sstream>
#include <string_view>
#include <unordered_map>

#include "geometry/bad_shape.h"
#include "reader/meshes/file_text.h"
#include "reader/meshes/words.h"

namespace plumb::reader {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

struct ObjGroup {
    std::string name;
    std::vector<Triangle> triangles;
};

struct ObjFile {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<ObjGroup> groups;
};

/// The loader reads what is no number as 0, so vertices are checked beforehand.
void check_vertices(const std::string& text) {
    std::istringstream stream(text);
    std::string buffer;
    for (std::size_t number = 1; std::getline(stream, buffer); ++number) {
        std::string_view line = buffer;
        if (next_word(line) != "v") continue;
        for (int i = 0; i < 3; ++i) {
            if (!finite_number(next_word(line))) {
                throw BadShape("line " + std::to_string(number) +
                               " must be \"v\" and three finite numbers");
            }
        }
    }
}

std::vector<Eigen::Vector3d> vertices_of(const tinyobj::attrib_t& attributes) {
    std::vector<Eigen::Vector3d> vertices(attributes.vertices.size() / 3);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        vertices[i] = Eigen::Map<const Eigen::Vector3d>(attributes.vertices.data() + 3 * i);
    }
    return vertices;
}

bool has_area(const Triangle& t, const std::vector<Eigen::Vector3d>& vertices) {
    const Eigen::Vector3d u = vertices[t[1]] - vertices[t[0]], v = vertices[t[2]] - vertices[t[0]];
    return u.cross(v).norm() > 0;
}

ObjGroup group_of(const tinyobj::shape_t& shape, const std::vector<Eigen::Vector3d>& vertices) {
    ObjGroup group{shape.name, {}};
    const auto& indices = shape.mesh.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const int index = indices[i + k].vertex_index;
            if (index < 0 || static_cast<std::size_t>(index) >= vertices.size()) {
                throw BadShape("a face names vertex " + std::to_string(index + 1) +
                               ", but the file has " + std::to_string(vertices.size()));
            }
            triangle[k] = static_cast<std::uint32_t>(index);
        }
        if (has_area(triangle, vertices)) group.triangles.push_back(triangle);
    }
    return group;
}

ObjFile parse_obj(const std::string& text) {
    check_vertices(text);
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warnings, errors;
    std::istringstream stream(text);
    const bool triangulate = true;
    const bool good = tinyobj::LoadObj(&attributes, &shapes, &materials, &warnings, &errors,
                                       &stream, nullptr, triangulate, false);
    if (!good) throw BadShape("not a good OBJ file: " + errors.substr(0, errors.find('\n')));

    ObjFile obj{vertices_of(attributes), {}};
    for (const auto& shape : shapes) {
        ObjGroup group = group_of(shape, obj.vertices);
        if (!group.triangles.empty()) obj.groups.push_back(std::move(group));
    }
    if (obj.groups.empty()) throw BadShape("there are no faces (with an area) in it");
    return obj;
}

ObjFile load(const std::filesystem::path& file) {
    const std::string text = text_of_mesh(file);
    try {
        return parse_obj(text);
    } catch (const BadShape& error) {
        throw BadShape("mesh file \"" + file.string() + "\": " + error.what());
    }
}

/// Appends triangles to a mesh, with the vertices that they use.
class MeshBuilder {
public:
    explicit MeshBuilder(const std::vector<Eigen::Vector3d>& vertices) : vertices_(vertices) {}

    void append(const std::vector<Triangle>& triangles) {
        for (const Triangle& t : triangles) {
            mesh_.triangles.push_back({kept(t[0]), kept(t[1]), kept(t[2])});
        }
    }

    TriangleMesh take(std::string name) {
        mesh_.name = std::move(name);
        return std::move(mesh_);
    }

private:
    std::uint32_t kept(std::uint32_t index) {
        const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
        const auto [place, is_new] = new_index_.emplace(index, next);
        if (is_new) mesh_.vertices.push_back(vertices_[index]);
        return place->second;
    }

    const std::vector<Eigen::Vector3d>& vertices_;
    std::unordered_map<std::uint32_t, std::uint32_t> new_index_;
    TriangleMesh mesh_;
};

}  // namespace

TriangleMesh load_obj(const std::filesystem::path& file) {
    const ObjFile obj = load(file);
    MeshBuilder builder(obj.vertices);
    for (const ObjGroup& group : obj.groups) builder.append(group.triangles);
    return builder.take(file.stem().string());
}

std::vector<TriangleMesh> load_obj_groups(const std::filesystem::path& file) {
    const ObjFile obj = load(file);
    std::vector<TriangleMesh> meshes;
    for (const ObjGroup& group : obj.groups) {
        MeshBuilder builder(obj.vertices);
        builder.append(group.triangles);
        meshes.push_back(builder.take(group.name));
    }
    return meshes;
}

}  // namespace plumb::reader
