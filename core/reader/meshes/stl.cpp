// SPDX-License-Identifier: MIT
#include "reader/meshes/stl.h"

#include <Eigen/Geometry>
#include <bit>
#include <map>
#include <string_view>

#include "geometry/bad_shape.h"
#include "reader/meshes/file_text.h"
#include "reader/meshes/words.h"

namespace plumb::reader {

namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

// A file of bytes: a header, the number of facets, and for each its normal, three corners and two
// bytes more.
constexpr std::size_t kHeader = 80, kCount = 4, kFacet = 50, kNormal = 12;

class FacetBuilder {
public:
    void add(const Corners& corners) {
        for (const Eigen::Vector3d& p : corners) {
            if (!p.allFinite()) throw BadShape("a corner is not three finite numbers");
        }
        if (!((corners[1] - corners[0]).cross(corners[2] - corners[0]).norm() > 0)) return;
        mesh_.triangles.push_back({index(corners[0]), index(corners[1]), index(corners[2])});
    }

    TriangleMesh take(std::string name) {
        if (mesh_.triangles.empty()) throw BadShape("there are no facets (with an area) in it");
        mesh_.name = std::move(name);
        return std::move(mesh_);
    }

private:
    std::uint32_t index(const Eigen::Vector3d& p) {
        const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
        const auto [place, is_new] = indices_.emplace(std::array{p.x(), p.y(), p.z()}, next);
        if (is_new) mesh_.vertices.push_back(p);
        return place->second;
    }

    std::map<std::array<double, 3>, std::uint32_t> indices_;
    TriangleMesh mesh_;
};

/// Four bytes, the lowest first.
std::uint32_t word_at(std::string_view bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
    return word;
}

bool is_of_bytes(std::string_view bytes) {
    return bytes.size() >= kHeader + kCount &&
           bytes.size() == kHeader + kCount + kFacet * std::size_t{word_at(bytes, kHeader)};
}

void read_bytes(FacetBuilder& mesh, std::string_view bytes) {
    for (std::size_t facet = kHeader + kCount; facet < bytes.size(); facet += kFacet) {
        Corners corners;
        for (std::size_t i = 0; i < 9; ++i) {
            const float value = std::bit_cast<float>(word_at(bytes, facet + kNormal + 4 * i));
            corners[i / 3][static_cast<Eigen::Index>(i % 3)] = value;
        }
        mesh.add(corners);
    }
}

double number(std::string_view word) {
    const std::optional<double> value = finite_number(word);
    if (!value) throw BadShape("\"" + std::string(word) + "\" stands where a coordinate should be");
    return *value;
}

void read_text(FacetBuilder& mesh, std::string_view text) {
    Corners corners;
    std::size_t count = 0;
    while (true) {
        const std::string_view word = next_word(text);
        if (word.empty()) break;
        if (word == "outer") count = 0;
        if (word == "vertex") {
            if (count == 3) throw BadShape("a facet has more than three corners");
            for (double& x : corners[count]) x = number(next_word(text));
            ++count;
        }
        if (word == "endloop") {
            if (count != 3) throw BadShape("a facet has fewer than three corners");
            mesh.add(corners);
        }
    }
}

TriangleMesh parse_stl(std::string_view bytes, const std::string& name) {
    FacetBuilder mesh;
    if (is_of_bytes(bytes)) {
        read_bytes(mesh, bytes);
    } else if (bytes.starts_with("solid")) {
        read_text(mesh, bytes);
    } else {
        throw BadShape("its size is not that of the number of facets that it states");
    }
    return mesh.take(name);
}

}  // namespace

TriangleMesh load_stl(const std::filesystem::path& file) {
    const std::string bytes = text_of_mesh(file);
    try {
        return parse_stl(bytes, file.stem().string());
    } catch (const BadShape& error) {
        throw BadShape("mesh file \"" + file.string() + "\": " + error.what());
    }
}

}  // namespace plumb::reader
