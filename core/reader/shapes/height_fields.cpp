// SPDX-License-Identifier: MIT
#include "reader/shapes/height_fields.h"

#include <cmath>

#include "geometry/hills.h"

namespace plumb::reader {

namespace {

using G = Geometry;

constexpr std::uint64_t kMostHeights = 16'000'000;

/// Heights of a field, row after row along z.
struct HeightList {
    std::vector<double> read(const Node& node) const {
        if (!node.json().is_array()) node.fail_wanting("a list of heights");
        std::vector<double> heights;
        heights.reserve(node.size());
        for (std::size_t i = 0; i < node.size(); ++i) {
            heights.push_back(Number{{-1e6, 1e6}}.read(node.at(i)));
        }
        return heights;
    }
    SchemaJson schema() const {
        return {{"type", "array"}, {"items", Number{{-1e6, 1e6}}.schema()}};
    }
};

const Table<Hills>& hills_table() {
    using H = Hills;
    constexpr double kMostExact = 9007199254740992.0;  // 2^53, up to which JSON keeps whole numbers
    static const Table<H> table = {
        field<H>("amplitude", Number{{0, 1e5}}, &H::amplitude,
                 "greatest height of the first octave, up and down [m]", Presence::required),
        field<H>("wavelength", Number{kLength}, &H::wavelength,
                 "distance between the first octave's random heights [m]", Presence::required),
        field<H>("octaves", Whole<std::uint32_t>{{1, 12}}, &H::octaves,
                 "layers of hills, each half as wide and half as high as the one before"),
        field<H>("seed", Whole<std::uint64_t>{{0, kMostExact}}, &H::seed, "seed of all heights"),
    };
    return table;
}

struct FieldDraft {
    Geometry geometry;
    std::optional<Hills> hills;
};

void read_spacing(FieldDraft& draft, const Node& node) {
    require_list(node, 2, "distances: between columns along x, between rows along z");
    draft.geometry.spacing_x = Number{kLength}.read(node.at(0));
    draft.geometry.spacing_z = Number{kLength}.read(node.at(1));
}

const Table<FieldDraft>& height_field_table() {
    using F = FieldDraft;
    constexpr Range lines{2, 65536};
    static const Table<F> table = {
        field<F>(
            "rows", Whole<std::uint32_t>{lines}, [](F & f) -> auto& { return f.geometry.rows; },
            "rows, one behind the other along z", Presence::required),
        field<F>(
            "columns", Whole<std::uint32_t>{lines},
            [](F & f) -> auto& { return f.geometry.columns; }, "columns along x",
            Presence::required),
        special<F>("spacing",
                   {{"type", "array"},
                    {"items", Number{kLength}.schema()},
                    {"minItems", 2},
                    {"maxItems", 2}},
                   read_spacing, "[x, z]: distance between columns, and between rows [m]",
                   Presence::required),
        field<F>(
            "heights", HeightList{}, [](F & f) -> auto& { return f.geometry.heights; },
            "rows × columns heights, row after row [m]"),
        special<F>(
            "hills", reference_to("hills"),
            [](F& f, const Node& node) { read_object(f.hills.emplace(), node, hills_table()); },
            "heights made by a rule: hills and hollows at random"),
    };
    return table;
}

Geometry field_of(const Node& node) {
    FieldDraft draft;
    read_object(draft, node, height_field_table());
    node.require_one("heights", "hills");
    Geometry& g = draft.geometry;
    g.kind = ShapeKind::height_field;
    const std::uint64_t wanted = std::uint64_t{g.rows} * g.columns;
    if (wanted > kMostHeights) {
        node.fail("these are " + std::to_string(wanted) +
                  " heights, but a height field may have at most " + std::to_string(kMostHeights));
    }
    if (draft.hills) {
        const double longest = std::max((g.columns - 1) * g.spacing_x, (g.rows - 1) * g.spacing_z);
        const double finest = draft.hills->wavelength / std::exp2(draft.hills->octaves - 1);
        if (longest / finest > 4096)
            node.at("hills").fail("the hills are too fine: over 4096 of them along a side");
        g.heights = heights_of(*draft.hills, g.rows, g.columns, g.spacing_x, g.spacing_z);
    } else if (g.heights.size() != wanted) {
        node.at("heights").fail("must have rows × columns = " + std::to_string(wanted) +
                                " heights, but has " + std::to_string(g.heights.size()));
    }
    return std::move(g);
}

}  // namespace

void read_height_field(ShapeDraft& draft, const Node& node) { draft.geometry = field_of(node); }

SchemaJson height_field_schema() {
    SchemaJson json = object_schema(height_field_table());
    json["oneOf"] = {{{"required", {"heights"}}}, {{"required", {"hills"}}}};
    return json;
}

void add_height_field_definitions(SchemaJson& definitions) {
    definitions["hills"] = object_schema(hills_table());
}

}  // namespace plumb::reader
