// SPDX-License-Identifier: MIT
/// Entries {"repeat": …, "bodies": […]}: bodies dealt over the places of a grid.
///
/// Places run along x first, then z, then y, so a grid fills from the bottom. What is listed is
/// dealt in the proportion of their weights and shuffled by the seed; then each place in turn draws
/// its jitter (x, y, z) and its rotation. All draws come from one `Random`.
#include "reader/repeat.h"

#include <cmath>

#include "reader/json/lists.h"

namespace plumb::reader {

namespace {

constexpr Range kJitter{0, 1e6}, kCounts{1, static_cast<double>(kMaxBodies)};

void read_jitter(Grid& grid, const Node& node) {
    grid.jitter = node.json().is_number()
                      ? Eigen::Vector3d::Constant(Number{kJitter}.read(node)).eval()
                      : Vector3{kJitter}.read(node);
}

struct RepeatDraft {
    SceneDraft* scene;
    Grid grid;
    std::vector<BodyDraft> prototypes;
};

void read_prototypes(RepeatDraft& draft, const Node& node) {
    if (!node.json().is_array() || node.size() == 0)
        node.fail_wanting("a list of at least one body");
    for (std::size_t i = 0; i < node.size(); ++i) {
        draft.prototypes.push_back(read_body(*draft.scene, node.at(i), true));
    }
}

const Table<RepeatDraft>& repeat_table() {
    using R = RepeatDraft;
    static const Table<R> table = {
        special<R>(
            "repeat", reference_to("grid"),
            [](R& r, const Node& node) { read_object(r.grid, node, grid_table()); }, "the grid",
            Presence::required),
        special<R>("bodies", list_of("prototype"), read_prototypes,
                   "bodies to deal over the grid; position and rotation are relative to the place",
                   Presence::required),
    };
    return table;
}

/// Without jitter [m].
Eigen::Vector3d middle_of(const Grid& grid, std::size_t index) {
    const std::size_t nx = grid.count[0], nz = grid.count[2];
    const std::array<std::size_t, 3> step{index % nx, index / (nx * nz), index / nx % nz};
    Eigen::Vector3d position = grid.origin;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const double middle = grid.centered[a] ? (grid.count[a] - 1) / 2.0 : 0;
        position[axis] += grid.spacing[axis] * (static_cast<double>(step[a]) - middle);
    }
    return position;
}

/// Moves a body and its script from the prototype's frame to a place of the grid.
void put(BodySpec& body, const Placement& place) {
    const auto moved = [&](Placement& p) {
        p.position += place.position;
        p.rotation = place.rotation * p.rotation;
    };
    moved(body.placement);
    for (Keyframe& keyframe : body.script.keyframes) moved(keyframe.placement);
}

}  // namespace

const Table<Grid>& grid_table() {
    using W = Whole<std::uint32_t>;
    static const Table<Grid> table = {
        field<Grid>("count", WholeList<3>{kCounts}, &Grid::count,
                    "[nx, ny, nz]: places along each axis", Presence::required),
        field<Grid>("spacing", Vector3{kCoordinate}, &Grid::spacing, "distance between places [m]"),
        field<Grid>("origin", Vector3{kCoordinate}, &Grid::origin,
                    "of the first place, and of the middle on axes that are centred [m]"),
        field<Grid>("centered", Flags3{}, &Grid::centered,
                    "axes on which the grid's middle lies at the origin"),
        field<Grid>("total", W{{1, static_cast<double>(kMaxBodies)}}, &Grid::total,
                    "stop after so many; places run along x, then z, then y"),
        special<Grid>("jitter", {{"anyOf", {Number{kJitter}.schema(), Vector3{kJitter}.schema()}}},
                      read_jitter, "greatest random displacement along each axis, either way [m]"),
        field<Grid>("random_rotation", Flag{}, &Grid::random_rotation,
                    "turn each body, uniformly over all rotations"),
        field<Grid>("seed", Whole<std::uint64_t>{{0, kMostExact}}, &Grid::seed,
                    "seed of all draws of this entry"),
    };
    return table;
}

std::uint64_t total_of(const Grid& grid, const Node& node) {
    const std::uint64_t places = std::uint64_t{grid.count[0]} * grid.count[1] * grid.count[2];
    if (grid.total && *grid.total > places)
        node.at("total").fail("the grid has only " + std::to_string(places) + " places");
    return grid.total ? *grid.total : places;
}

std::vector<std::size_t> dealt(const std::vector<double>& weights, std::size_t total,
                               Random& random) {
    double sum = 0;
    for (const double weight : weights) sum += weight;

    std::vector<std::size_t> choice;
    choice.reserve(total);
    double so_far = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        so_far += weights[i];
        const bool last = i + 1 == weights.size();
        const double end = last ? static_cast<double>(total)
                                : std::round(static_cast<double>(total) * so_far / sum);
        while (static_cast<double>(choice.size()) < end) choice.push_back(i);
    }

    // Fisher and Yates, from the back.
    for (std::size_t i = total; i > 1; --i) std::swap(choice[i - 1], choice[random.below(i)]);
    return choice;
}

Placement drawn_place(const Grid& grid, std::size_t index, Random& random) {
    Placement place{middle_of(grid, index), Eigen::Quaterniond::Identity()};
    for (int axis = 0; axis < 3; ++axis)
        place.position[axis] += random.between(-grid.jitter[axis], grid.jitter[axis]);
    if (grid.random_rotation) place.rotation = random.rotation();
    return place;
}

void read_repeat(SceneDraft& draft, const Node& node) {
    RepeatDraft entry{&draft, {}, {}};
    read_object(entry, node, repeat_table());
    const std::uint64_t total = total_of(entry.grid, node.at("repeat"));
    if (total > kMaxBodies - draft.scene.bodies.size())
        node.at("repeat").fail("these are " + std::to_string(total) +
                               " bodies, but a scene may have at most " +
                               std::to_string(kMaxBodies));

    Random random(entry.grid.seed);
    std::vector<double> weights;
    for (const BodyDraft& p : entry.prototypes) weights.push_back(p.weight);
    const std::vector<std::size_t> choice = dealt(weights, total, random);
    for (std::size_t i = 0; i < total; ++i) {
        const Placement place = drawn_place(entry.grid, i, random);
        BodySpec body = entry.prototypes[choice[i]].spec;
        body.name = numbered(body.name, i + 1);
        put(body, place);
        add_body(draft, std::move(body), node);
    }
}

void add_repeat_definitions(SchemaJson& definitions) {
    definitions["grid"] = object_schema(grid_table());
    definitions["repeat"] = object_schema(repeat_table());
}

}  // namespace plumb::reader
