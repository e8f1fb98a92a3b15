// SPDX-License-Identifier: MIT
#include "reader/meshes/stl.h"

#include <bit>
#include <limits>

#include "geometry/bad_shape.h"
#include "robots.h"

namespace plumb::test {

namespace {

using Facet = std::array<float, 9>;

const std::vector<Facet> kTwo = {{0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 0, 0, 1, 1, 0, 0, 1, 0.5f}};

void put(std::string& bytes, std::uint32_t word) {
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(word >> 8 * i & 255);
}

std::string as_bytes(const std::vector<Facet>& facets, const std::string& header) {
    std::string bytes = header;
    bytes.resize(80, ' ');
    put(bytes, static_cast<std::uint32_t>(facets.size()));
    for (const Facet& facet : facets) {
        for (int i = 0; i < 3; ++i) put(bytes, 0);
        for (const float x : facet) put(bytes, std::bit_cast<std::uint32_t>(x));
        bytes += std::string(2, '\0');
    }
    return bytes;
}

std::string as_text(const std::vector<Facet>& facets) {
    std::ostringstream text;
    text << "solid two words\n";
    for (const Facet& f : facets) {
        text << " facet normal 0 0 1\n  outer loop\n";
        for (std::size_t i = 0; i < 9; i += 3)
            text << "   vertex " << f[i] << ' ' << f[i + 1] << ' ' << f[i + 2] << "e+00\r\n";
        text << "  endloop\n endfacet\n";
    }
    return text.str() + "endsolid two words\n";
}

}  // namespace

class Stl : public Robots {
protected:
    std::string reason_for(const std::string& content) const {
        try {
            reader::load_stl(write("mesh.stl", content));
        } catch (const BadShape& error) {
            return error.what();
        }
        return "no error";
    }
};

TEST_F(Stl, BytesAndTextAreTheSame) {
    // A header that begins as a text does is no text.
    for (const std::string& content :
         {as_bytes(kTwo, "header"), as_bytes(kTwo, "solid"), as_text(kTwo)}) {
        const auto mesh = reader::load_stl(write("mesh.stl", content));
        EXPECT_EQ(mesh.name, "mesh");
        EXPECT_EQ(mesh.vertices.size(), 4u);
        const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
        EXPECT_EQ(mesh.triangles, triangles);
        expect_near(mesh.vertices[3], {0, 1, 0.5}, 0);
    }
}

TEST_F(Stl, LeavesOutFacetsWithoutArea) {
    std::vector<Facet> facets = kTwo;
    facets.push_back({0, 0, 0, 1, 1, 1, 2, 2, 2});
    EXPECT_EQ(reader::load_stl(write("mesh.stl", as_bytes(facets, ""))).triangles.size(), 2u);
}

TEST_F(Stl, RefusesWhatIsNoMesh) {
    expect_words(reason_for(""), "its size is not that of the number of facets");
    expect_words(reason_for(as_bytes(kTwo, "") + "x"), "its size");
    expect_words(reason_for(as_bytes({}, "")), "no facets");
    expect_words(reason_for("solid empty\nendsolid"), "no facets");
    expect_words(reason_for("solid\nouter loop\nvertex 0 0 x"), "\"x\" stands where a coordinate");
    expect_words(reason_for("solid\nouter loop\nvertex 0 0"), "\"\" stands where a coordinate");
    expect_words(reason_for("solid\nouter loop\nvertex 0 0 0\nendloop"), "fewer than three");
    expect_words(reason_for("solid\nouter loop" + std::string("\nvertex 0 0 1") +
                            "\nvertex 0 1 0\nvertex 1 0 0\nvertex 1 1 1"),
                 "more than three");
    std::vector<Facet> infinite = kTwo;
    infinite[0][4] = std::numeric_limits<float>::infinity();
    expect_words(reason_for(as_bytes(infinite, "")), "finite");
    try {
        reader::load_stl(folder_ / "gone.stl");
        ADD_FAILURE() << "no error";
    } catch (const BadShape& error) {
        expect_words(error.what(), "gone.stl");
    }
}

}  // namespace plumb::test
