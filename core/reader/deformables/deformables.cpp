// SPDX-License-Identifier: MIT
/// "deformables".
#include "reader/deformables/deformables.h"

#include <algorithm>
#include <sstream>

#include "reader/repeat.h"
#include "scene/deformable_faults.h"
#include "scene/link_faults.h"

namespace plumb::reader {

namespace {

using D = DeformableDraft;

constexpr double kSoft = 1e6, kRopes = 1e8;  // Young's moduli, like rubber's and a rope's [Pa]
constexpr double kSheetThickness = 1e-3, kRopeDiameter = 1e-2;  // [m]
constexpr double kLeastRadius = 0.1;                            // over the mean length of an edge

Number within(const DeformableBounds& bounds) { return Number{{bounds.low, bounds.high}}; }

const Table<D>& look_table() {
    using Bits = Whole<std::uint32_t>;
    constexpr Range bits{0, 4294967295.0};
    static const Table<D> table = {
        field<D>(
            "group", Bits{bits}, [](D & d) -> auto& { return d.spec.group; },
            "bits; a and b collide if group of a & mask of b, and group of b & mask of a"),
        field<D>(
            "mask", Bits{bits}, [](D & d) -> auto& { return d.spec.mask; }, "bits, see group"),
        field<D>(
            "color", Color{}, [](D & d) -> auto& { return d.spec.color; }, "\"#rrggbb\""),
        special<D>(
            "attach", list_of("attachment"), [](D&, const Node&) {},
            "points that ride on bodies, or stay where they are"),
    };
    return table;
}

const Table<D>& elasticity_table() {
    static const Table<D> table = {
        special<D>(
            "material", Text{}.schema(),
            [](D& d, const Node& n) { d.spec.material = d.scene->materials.find(n); },
            "name of a material"),
        field<D>(
            "mass", within(kDeformableMassBounds), [](D & d) -> auto& { return d.spec.mass; },
            "of the whole [kg]; left out: density × volume"),
        field<D>("thickness", within(kThicknessBounds), &D::thickness,
                 "of cloth and balloons, 0.001 is the default; a rope's diameter, 0.01 [m]"),
        field<D>("young", within(kYoungBounds), &D::young,
                 "Young's modulus; 1e6 is the default, 1e8 of a rope [Pa]"),
        field<D>(
            "poisson", Number{{-1, 1}},
            [](D & d) -> auto& { return d.spec.elasticity.poissons_ratio; },
            "Poisson's ratio, above -1 and below 1, in a solid below 0.5; 0.3 is the default"),
        field<D>(
            "bending", within(kBendingBounds),
            [](D & d) -> auto& { return d.spec.elasticity.bending_stiffness; },
            "stiffness against bending of cloth and balloons [N m], of ropes [N m²]; left out: "
            "from young and thickness"),
        field<D>(
            "damping", within(kStrainDampingBounds),
            [](D & d) -> auto& { return d.spec.elasticity.damping; },
            "stress of a rate of strain, over young [s]; 0 is the default"),
        field<D>(
            "volume_ratio", within(kVolumeRatioBounds),
            [](D & d) -> auto& { return d.spec.volume_ratio; },
            "volume that a balloon keeps, over the volume of its shape; 1 is the default"),
        field<D>(
            "pressure", within(kPressureBounds), [](D & d) -> auto& { return d.spec.pressure; },
            "in a balloon, over that outside, in place of a volume to keep [Pa]"),
        field<D>(
            "drag", within(kDragBounds), [](D & d) -> auto& { return d.spec.drag; },
            "coefficient of drag of a surface across the wind: 1.2, of a flat plate, is the "
            "default"),
        field<D>(
            "skin_drag", within(kDragBounds), [](D & d) -> auto& { return d.spec.skin_drag; },
            "coefficient of drag of each side of a surface along the wind; 0.01 is the default"),
        field<D>("radius", within(kParticleRadiusBounds), &D::radius,
                 "of its points, for contacts; left out: half the thickness, but at least a tenth "
                 "of the mean length of an edge [m]"),
        field<D>(
            "tearing_strain", Number{{kLeastTearingStrain, 1e9}},
            [](D & d) -> auto& { return d.spec.tearing_strain; },
            "strain at which it tears; left out: it never does"),
    };
    return table;
}

const Table<D>& deformable_table() {
    static const Table<D> table = [] {
        using Kind = DeformableKind;
        Table<D> fields = {
            field<D>(
                "name", Text{}, [](D & d) -> auto& { return d.spec.name; },
                "name for links, errors and recordings"),
            field<D>(
                "kind",
                Choice<Kind>{{{"cloth", Kind::cloth},
                              {"balloon", Kind::balloon},
                              {"solid", Kind::solid},
                              {"rope", Kind::rope}}},
                [](D & d) -> auto& { return d.spec.kind; },
                "cloth, balloon: closed, with a volume or a pressure, solid, or rope",
                Presence::required),
            special<D>("shape", reference_to("deformable_shape"), read_deformable_shape,
                       "shape without strain", Presence::required),
            field<D>(
                "position", Vector3{kCoordinate},
                [](D & d) -> auto& { return d.placement.position; },
                "of the shape's frame at the start [m]"),
            field<D>(
                "rotation", Rotation{}, [](D & d) -> auto& { return d.placement.rotation; },
                "of the shape's frame at the start"),
            field<D>(
                "velocity", Vector3{kCoordinate}, [](D & d) -> auto& { return d.spec.velocity; },
                "of all points at the start [m/s]"),
        };
        for (const Table<D>* more : {&elasticity_table(), &look_table()})
            fields.insert(fields.end(), more->begin(), more->end());
        return fields;
    }();
    return table;
}

/// Keys that are of some kinds alone.
void check_keys(const D& draft, const Node& node) {
    using Kind = DeformableKind;
    struct Of {
        const char* key;
        std::vector<Kind> kinds;
    };
    static const std::vector<Of> special_keys = {
        {"thickness", {Kind::cloth, Kind::balloon, Kind::rope}},
        {"bending", {Kind::cloth, Kind::balloon, Kind::rope}},
        {"poisson", {Kind::cloth, Kind::balloon, Kind::solid}},
        {"drag", {Kind::cloth, Kind::balloon, Kind::solid}},
        {"skin_drag", {Kind::cloth, Kind::balloon, Kind::solid}},
        {"volume_ratio", {Kind::balloon}},
        {"pressure", {Kind::balloon}}};
    for (const auto& [key, kinds] : special_keys) {
        const bool able = std::find(kinds.begin(), kinds.end(), draft.spec.kind) != kinds.end();
        if (node.has(key) && !able)
            node.at(key).fail("a " + std::string(name_of(draft.spec.kind)) + " has no \"" + key +
                              "\"");
    }
    if (node.has("pressure") && node.has("volume_ratio"))
        node.fail("a balloon has either a \"pressure\" or a \"volume_ratio\"");
}

template <std::size_t N>
void add_edges(const DeformableSpec& spec,
               const std::vector<std::array<std::uint32_t, N>>& elements, double& sum,
               std::size_t& count) {
    for (const auto& element : elements)
        for (std::size_t i = 0; i < N; ++i)
            for (std::size_t j = i + 1; j < N; ++j) {
                const std::uint32_t p = element[i], q = element[j];
                if (std::max(p, q) >= spec.points.size()) continue;
                sum += (spec.points[p] - spec.points[q]).norm();
                ++count;
            }
}

/// Mean length of the edges of all elements [m].
double mean_edge(const DeformableSpec& spec) {
    double sum = 0;
    std::size_t count = 0;
    add_edges(spec, spec.segments, sum, count);
    if (spec.kind != DeformableKind::solid) add_edges(spec, spec.triangles, sum, count);
    add_edges(spec, spec.tetrahedra, sum, count);
    return count > 0 ? sum / static_cast<double>(count) : 0;
}

void set_defaults(D& draft) {
    DeformableSpec& spec = draft.spec;
    const bool rope = spec.kind == DeformableKind::rope;
    spec.thickness = draft.thickness.value_or(rope ? kRopeDiameter : kSheetThickness);
    spec.elasticity.youngs_modulus = draft.young.value_or(rope ? kRopes : kSoft);
    const double half =
        spec.kind == DeformableKind::solid ? kParticleRadiusBounds.low : spec.thickness / 2;
    spec.radius =
        draft.radius.value_or(std::clamp(std::max(half, kLeastRadius * mean_edge(spec)),
                                         kParticleRadiusBounds.low, kParticleRadiusBounds.high));
}

/// Turns the triangles of a balloon over where all of them face inwards.
void turn_outwards(D& draft) {
    using namespace deformable_faults;
    DeformableSpec& spec = draft.spec;
    if (spec.kind != DeformableKind::balloon || element_fault(spec.points, spec.triangles) ||
        edge_fault(spec.triangles, true) || enclosed_volume(spec.points, spec.triangles) >= 0)
        return;
    for (auto& t : spec.triangles) std::swap(t[1], t[2]);
    draft.scene->scene.remarks.push_back("deformable \"" + spec.name +
                                         "\": its triangles faced inwards and were turned over");
}

void move_points(DeformableSpec& spec, const Placement& placement) {
    for (Eigen::Vector3d& p : spec.points) p = placement.position + placement.rotation * p;
}

void check_deformable(const D& draft, const Node& node) {
    if (const auto fault = deformable_fault(draft.spec, draft.scene->scene.materials.size()))
        place_of(*fault, node).fail(fault->sentence);
}

/// A deformable with its checks; of a "repeat" it may have a weight.
D read_deformable(SceneDraft& scene, const Node& node, const std::string& name,
                  const Table<D>& table) {
    D draft{&scene, {}, {}, {}, {}, {}, {}, 1};
    draft.spec.name = name;
    read_object(draft, node, table);
    check_keys(draft, node);
    move_points(draft.spec, draft.placement);
    set_defaults(draft);
    turn_outwards(draft);
    check_deformable(draft, node);
    // Where points are is known only now.
    if (node.has("attach"))
        draft.attachments = read_attachments(scene, draft.spec, node.at("attach"));
    return draft;
}

/// `node` is the deformable's own, `entry` the one of the list that it comes from.
void add_deformable(SceneDraft& scene, D draft, const Node& node, const Node& entry) {
    const auto index = static_cast<std::uint32_t>(scene.scene.deformables.size());
    scene.deformables.add(draft.spec.name, index, entry);
    scene.points += draft.spec.points.size();
    scene.scene.deformables.push_back(std::move(draft.spec));
    for (std::size_t i = 0; i < draft.attachments.size(); ++i) {
        AttachmentSpec& attachment = draft.attachments[i];
        attachment.deformable = index;
        if (const auto fault = attachment_fault(scene.scene, attachment))
            place_of(*fault, node.at("attach").at(i)).fail(fault->sentence);
        scene.scene.attachments.push_back(std::move(attachment));
    }
}

const Table<D>& prototype_table() {
    static const Table<D> table = [] {
        Table<D> fields = deformable_table();
        fields.push_back(field<D>("weight", Number{kWeight}, &D::weight,
                                  "share of this deformable among those that a repeat deals"));
        return fields;
    }();
    return table;
}

struct RepeatDraft {
    SceneDraft* scene;
    Grid grid;
    std::vector<D> prototypes;
};

void read_prototypes(RepeatDraft& draft, const Node& node) {
    if (!node.json().is_array() || node.size() == 0)
        node.fail_wanting("a list of at least one deformable");
    for (std::size_t i = 0; i < node.size(); ++i)
        draft.prototypes.push_back(read_deformable(
            *draft.scene, node.at(i),
            "deformable_" + std::to_string(draft.scene->scene.deformables.size() + 1),
            prototype_table()));
}

const Table<RepeatDraft>& repeat_table() {
    using R = RepeatDraft;
    static const Table<R> table = {
        special<R>(
            "repeat", reference_to("grid"),
            [](R& r, const Node& node) { read_object(r.grid, node, grid_table()); }, "the grid",
            Presence::required),
        special<R>("deformables", list_of("deformable_prototype"), read_prototypes,
                   "deformables to deal over the grid; position, rotation and the places of "
                   "\"attach\" are relative to the place",
                   Presence::required),
    };
    return table;
}

void read_repeated(SceneDraft& scene, const Node& node) {
    RepeatDraft entry{&scene, {}, {}};
    read_object(entry, node, repeat_table());
    const std::uint64_t total = total_of(entry.grid, node.at("repeat"));
    std::size_t fewest = kMaxParticles;
    std::vector<double> weights;
    for (const D& p : entry.prototypes) {
        fewest = std::min(fewest, p.spec.points.size());
        weights.push_back(p.weight);
    }
    require_room(scene, static_cast<double>(total) * static_cast<double>(fewest),
                 node.at("repeat"));

    Random random(entry.grid.seed);
    const std::vector<std::size_t> choice = dealt(weights, total, random);
    for (std::size_t i = 0; i < total; ++i) {
        D draft = entry.prototypes[choice[i]];
        require_room(scene, static_cast<double>(draft.spec.points.size()), node.at("repeat"));
        draft.spec.name = numbered(draft.spec.name, i + 1);
        move_points(draft.spec, drawn_place(entry.grid, i, random));
        const Node prototype = node.at("deformables").at(choice[i]);
        check_deformable(draft, prototype);
        add_deformable(scene, std::move(draft), prototype, node);
    }
}

}  // namespace

Node place_of(const DeformableFault& fault, const Node& whole) {
    Node place = whole;
    std::istringstream parts(fault.place.substr(std::min<std::size_t>(1, fault.place.size())));
    for (std::string part; std::getline(parts, part, '/');) {
        if (!place.has(part) && place.has("shape")) {
            place = place.at("shape");
            if (place.has("mesh")) place = place.at("mesh");
        }
        if (place.has(part))
            place = place.at(part);
        else if (place.json().is_array() && std::stoul(part) < place.size())
            place = place.at(std::stoul(part));
        else
            break;
    }
    return place;
}

void read_deformables(SceneDraft& draft, const Node& node) {
    if (!node.json().is_array()) node.fail_wanting("a list of deformables");
    for (std::size_t i = 0; i < node.size(); ++i) {
        const Node entry = node.at(i);
        if (entry.has("repeat"))
            read_repeated(draft, entry);
        else
            add_deformable(
                draft,
                read_deformable(draft, entry,
                                "deformable_" + std::to_string(draft.scene.deformables.size() + 1),
                                deformable_table()),
                entry, entry);
    }
}

void add_deformable_definitions(SchemaJson& definitions) {
    add_deformable_shape_definitions(definitions);
    definitions["deformable"] = object_schema(deformable_table());
    definitions["deformable_prototype"] = object_schema(prototype_table());
    definitions["deformable_repeat"] = object_schema(repeat_table());
    definitions["deformable_entry"] = {{"if", {{"required", {"repeat"}}}},
                                       {"then", reference_to("deformable_repeat")},
                                       {"else", reference_to("deformable")}};
    add_attachment_definitions(definitions);
}

}  // namespace plumb::reader
