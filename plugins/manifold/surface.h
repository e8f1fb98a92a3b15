// SPDX-License-Identifier: MIT
/// The triangles of a mesh or of a height field, made ready for questions: where is the point of
/// the surface nearest to a point, on which side of it does the point lie, where does a ray hit.
///
/// Vertices in one place are made one, triangles without area are dropped. The side is told by
/// pseudonormals (Baerentzen and Aanaes): at an edge the sum of its triangles' normals, at a vertex
/// the sum weighted by the triangles' angles. That is right everywhere around a closed mesh.
#pragma once

#include "manifold/box_tree.h"
#include "manifold/mesh_topology.h"

#include <memory>
#include <vector>

namespace plumb {

inline bool has_surface(ShapeKind kind) {
    return kind == ShapeKind::mesh || kind == ShapeKind::height_field;
}

/// The nearest point of a surface.
struct NearestPoint {
    Vec3 point{};                ///< on the surface [m]
    Vec3 pseudonormal{};         ///< unit, there
    double squared = 0;          ///< distance² [m²]
    std::uint32_t triangle = 0;  ///< as the shape numbers them
    bool found = false;
};

struct SurfaceHit {
    double distance = 0;         ///< along the ray [m]
    Vec3 normal{};               ///< of the triangle, unit
    std::uint32_t triangle = 0;  ///< as the shape numbers them
    bool found = false;
};

class Surface {
public:
    /// Of a mesh or a height field; of a height field every cell makes two triangles, parted from
    /// the corner (row, column + 1) to (row + 1, column).
    explicit Surface(const Shape& shape);
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    /// Whether the triangles enclose a volume: every edge is run through as often one way as the
    /// other.
    bool closed() const { return closed_; }

    std::uint32_t size() const { return static_cast<std::uint32_t>(triangles_.size()); }
    const Vec3& corner(std::uint32_t triangle, int k) const {
        return vertices_[triangles_[triangle].corner[k]];
    }
    Vec3 normal(std::uint32_t triangle) const { return triangles_[triangle].normal; }
    /// The number that the shape gives a triangle.
    std::uint32_t number(std::uint32_t triangle) const { return triangles_[triangle].number; }

    const std::vector<Vec3>& vertices() const { return vertices_; }
    const MeshTopology& topology() const { return topology_; }
    const BoxTree& tree() const { return tree_; }
    Aabb box_of(std::uint32_t triangle) const;

    /// Point of the surface nearest to `p`, both in the shape's frame; not found beyond `within`
    /// [m].
    NearestPoint nearest(Vec3 p, double within) const;

    /// First triangle on a ray in the shape's frame, from either side.
    SurfaceHit hit(const Ray& ray, double length) const;

private:
    struct Triangle {
        std::uint32_t corner[3];
        std::uint32_t number;
        Vec3 normal;          ///< unit
        Vec3 edge_normal[3];  ///< unit, of the edge from corner k to the next
    };

    void take_mesh(const Shape& mesh);
    void take_height_field(const Shape& field);
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t number);
    void join_edges();
    void weigh_vertices();

    std::vector<Vec3> vertices_, vertex_normals_;
    std::vector<Triangle> triangles_;
    MeshTopology topology_;
    BoxTree tree_;
    bool closed_ = false;
};

/// The surface behind a shape; bodies that share the memory of their triangles share the surface.
class SurfaceStore {
public:
    std::shared_ptr<const Surface> of(const Shape& shape);

private:
    struct Entry {
        const void* key;  ///< where faces or heights stand
        std::weak_ptr<const Surface> surface;
    };
    std::vector<Entry> entries_;
};

}  // namespace plumb
