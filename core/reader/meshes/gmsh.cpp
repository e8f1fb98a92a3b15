// SPDX-License-Identifier: MIT
/// Gmsh's .msh as text: sections from $Name to $EndName, of which $Nodes and $Elements matter. In
/// version 2.2 each node and each element has a line; in 4.1 they come in blocks, one for each part
/// of the model.
#include <algorithm>

#include "reader/meshes/file_text.h"
#include "reader/meshes/numbered_points.h"
#include "reader/meshes/tet_meshes.h"

namespace plumb::reader {

namespace {

/// Types of elements by Gmsh's numbers.
struct Type {
    std::uint64_t number;
    int dimension;
    std::size_t points;
};
constexpr Type kTypes[] = {{1, 1, 2},   {2, 2, 3},   {3, 2, 4},   {4, 3, 4},   {5, 3, 8},
                           {6, 3, 6},   {7, 3, 5},   {8, 1, 3},   {9, 2, 6},   {10, 2, 9},
                           {11, 3, 10}, {12, 3, 27}, {13, 3, 18}, {14, 3, 14}, {15, 0, 1},
                           {16, 2, 8},  {17, 3, 20}, {18, 3, 15}, {19, 3, 13}};
constexpr std::uint64_t kTriangle = 2, kTetrahedron = 4;

class GmshReader {
public:
    GmshReader(MeshText& text, bool tetrahedra) : text_(text), dimension_(tetrahedra ? 3 : 2) {}

    Elements read() {
        read_format();
        bool nodes = false, elements = false;
        while (!text_.at_end()) {
            const std::string section(text_.word("a section"));
            if (!section.starts_with('$')) text_.fail("a section must begin with \"$\"");
            if (section == "$Nodes" && !nodes) {
                newer_ ? read_node_blocks() : read_nodes();
                nodes = true;
            } else if (section == "$Elements" && !elements) {
                if (!nodes) text_.fail("\"$Nodes\" must come before \"$Elements\"");
                newer_ ? read_element_blocks() : read_elements();
                elements = true;
            }
            pass_over(section);
        }
        return taken();
    }

private:
    void read_format() {
        if (text_.word("\"$MeshFormat\"") != "$MeshFormat")
            text_.fail("a .msh file must begin with \"$MeshFormat\"");
        const std::string version(text_.word("the version"));
        newer_ = version == "4.1";
        if (!newer_ && version != "2.2" && version != "2")
            text_.fail("the file is of version " + version +
                       "; 2.2 and 4.1 are read, and Gmsh can save as either (Mesh.MshFileVersion)");
        if (text_.whole("0, for text") != 0)
            text_.fail("the file is binary; save it as text (Mesh.Binary = 0)");
        pass_over("$MeshFormat");
    }

    /// Goes on to what follows the end of a section.
    void pass_over(const std::string& section) {
        const std::string end = "$End" + section.substr(1);
        while (text_.word("\"" + end + "\"") != end) {
        }
    }

    void add_node(std::uint64_t number) {
        const double x = text_.finite("x"), y = text_.finite("y"), z = text_.finite("z");
        points_.add(number, {x, y, z}, text_);
    }

    void read_nodes() {
        const std::uint64_t count = text_.whole("the number of nodes");
        for (std::uint64_t i = 0; i < count; ++i) add_node(text_.whole("the number of a node"));
    }

    void read_node_blocks() {
        const std::uint64_t blocks = text_.whole("the number of blocks");
        text_.end_line();
        for (std::uint64_t b = 0; b < blocks; ++b) {
            const std::uint64_t dimension = text_.whole("a dimension");
            text_.word("a part of the model");
            const bool parametric = text_.whole("0 or 1, for parameters") != 0;
            const std::uint64_t count = text_.whole("the number of nodes");
            std::vector<std::uint64_t> numbers;
            for (std::uint64_t i = 0; i < count; ++i)
                numbers.push_back(text_.whole("the number of a node"));
            for (const std::uint64_t number : numbers) {
                add_node(number);
                for (std::uint64_t i = 0; parametric && i < dimension; ++i)
                    text_.finite("a parameter");
            }
        }
    }

    /// Reads the points of an element, and keeps it if it is of the kind that is wanted.
    void add_element(std::uint64_t type_number) {
        const auto* type = std::find_if(std::begin(kTypes), std::end(kTypes),
                                        [&](const Type& t) { return t.number == type_number; });
        if (type == std::end(kTypes))
            text_.fail("elements of type " + std::to_string(type_number) +
                       " are not known; save the mesh with straight triangles and tetrahedra");
        const bool simplex = type_number == kTriangle || type_number == kTetrahedron;
        if (type->dimension == dimension_ && !simplex)
            text_.fail("elements of type " + std::to_string(type_number) + " are not read; " +
                       (dimension_ == 3 ? "only tetrahedra of 4 points (type 4) can be a solid"
                                        : "only triangles of 3 points (type 2) can be a surface"));
        std::array<std::uint64_t, 27> p{};
        for (std::size_t i = 0; i < type->points; ++i) p[i] = text_.whole("a node of an element");
        if (type->dimension != dimension_) return;
        if (dimension_ == 3)
            points_.add_element(tetrahedra_, {p[0], p[1], p[2], p[3]}, text_);
        else
            points_.add_element(triangles_, {p[0], p[1], p[2]}, text_);
    }

    void read_elements() {
        const std::uint64_t count = text_.whole("the number of elements");
        for (std::uint64_t i = 0; i < count; ++i) {
            text_.whole("the number of an element");
            const std::uint64_t type = text_.whole("the type of an element");
            const std::uint64_t tags = text_.whole("the number of an element's tags");
            for (std::uint64_t t = 0; t < tags; ++t) text_.word("a tag");
            add_element(type);
        }
    }

    void read_element_blocks() {
        const std::uint64_t blocks = text_.whole("the number of blocks");
        text_.end_line();
        for (std::uint64_t b = 0; b < blocks; ++b) {
            text_.whole("a dimension");
            text_.word("a part of the model");
            const std::uint64_t type = text_.whole("the type of the elements");
            const std::uint64_t count = text_.whole("the number of elements");
            for (std::uint64_t i = 0; i < count; ++i) {
                text_.whole("the number of an element");
                add_element(type);
            }
        }
    }

    Elements taken() const {
        Elements made;
        if (dimension_ == 3) {
            if (tetrahedra_.empty()) throw BadShape("there are no tetrahedra in it");
            made.tetrahedra = points_.taken(tetrahedra_, made.points);
        } else {
            if (triangles_.empty()) throw BadShape("there are no triangles in it");
            made.triangles = points_.taken(triangles_, made.points);
        }
        return made;
    }

    MeshText& text_;
    int dimension_;  ///< of the elements that are kept
    bool newer_ = false;
    NumberedPoints points_;
    std::vector<std::array<std::uint64_t, 3>> triangles_;
    std::vector<std::array<std::uint64_t, 4>> tetrahedra_;
};

}  // namespace

Elements load_gmsh(const std::filesystem::path& file, bool tetrahedra) {
    MeshText text(text_of_mesh(file), 0);
    try {
        return GmshReader(text, tetrahedra).read();
    } catch (const BadShape& error) {
        throw BadShape("mesh file \"" + file.string() + "\": " + error.what());
    }
}

}  // namespace plumb::reader
