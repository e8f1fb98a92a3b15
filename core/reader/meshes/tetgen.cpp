// SPDX-License-Identifier: MIT
/// TetGen's .node and .ele: a line of counts, then a line for each point or tetrahedron, which
/// begins with its number. What stands behind the coordinates or the four corners is passed over.
#include "reader/meshes/file_text.h"
#include "reader/meshes/numbered_points.h"
#include "reader/meshes/tet_meshes.h"

namespace plumb::reader {

namespace {

/// Reads a file and lets what is thrown name it.
template <class Read>
void read_file(const std::filesystem::path& file, Read read) {
    MeshText text(text_of_mesh(file), '#');
    try {
        read(text);
    } catch (const BadShape& error) {
        throw BadShape("mesh file \"" + file.string() + "\": " + error.what());
    }
}

NumberedPoints read_nodes(MeshText& text) {
    const std::uint64_t count = text.whole("the number of points");
    if (text.whole("the dimension, 3") != 3) text.fail("the points must have three coordinates");
    text.end_line();
    NumberedPoints points;
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t number = text.whole("the number of a point");
        const double x = text.finite("x"), y = text.finite("y"), z = text.finite("z");
        points.add(number, {x, y, z}, text);
        text.end_line();
    }
    return points;
}

void read_tetrahedra(MeshText& text, const NumberedPoints& points, Elements& made) {
    const std::uint64_t count = text.whole("the number of tetrahedra");
    const std::uint64_t corners = text.whole("the points of a tetrahedron, 4 or 10");
    if (corners != 4 && corners != 10) text.fail("a tetrahedron must have 4 or 10 points");
    text.end_line();
    std::vector<std::array<std::uint64_t, 4>> tetrahedra;
    for (std::uint64_t i = 0; i < count; ++i) {
        text.whole("the number of a tetrahedron");
        std::array<std::uint64_t, 4> t;
        for (std::uint64_t& corner : t) corner = text.whole("a corner of a tetrahedron");
        points.add_element(tetrahedra, t, text);
        text.end_line();
    }
    if (tetrahedra.empty()) text.fail("there are no tetrahedra in it");
    made.tetrahedra = points.taken(tetrahedra, made.points);
}

}  // namespace

Elements load_tetgen(const std::filesystem::path& node_file) {
    NumberedPoints points;
    read_file(node_file, [&](MeshText& text) { points = read_nodes(text); });
    Elements made;
    read_file(std::filesystem::path(node_file).replace_extension(".ele"),
              [&](MeshText& text) { read_tetrahedra(text, points, made); });
    return made;
}

}  // namespace plumb::reader
