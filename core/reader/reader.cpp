// SPDX-License-Identifier: MIT
/// A whole scene: its top-level keys, in the order in which they depend on each other.
#include "reader/reader.h"

#include "reader/drafts.h"
#include "reader/json/parse.h"
#include "reader/meshes/file_text.h"
#include "reader/robots/formats.h"
#include "reader/robots/robot.h"

namespace plumb::reader {

namespace {

void read_view(SceneDraft& draft, const Node& node) {
    View view;
    read_object(view, node, view_table());
    if ((view.eye - view.target).norm() < 1e-6)
        node.fail("\"eye\" and \"target\" are the same point");
    draft.scene.view = view;
}

}  // namespace

const Table<View>& view_table() {
    using V = View;
    static const Table<V> table = {
        field<V>("eye", Vector3{kCoordinate}, &V::eye, "where the picture is taken from [m]"),
        field<V>("target", Vector3{kCoordinate}, &V::target,
                 "point in the middle of the picture [m]"),
        field<V>("field_of_view", Number{{1, 170}}, &V::field_of_view, "vertical angle [degrees]"),
    };
    return table;
}

const Table<SceneDraft>& scene_table() {
    using D = SceneDraft;
    static const Table<D> table = {
        special<D>(
            "$schema", {{"type", "string"}}, [](D&, const Node& node) { Text{}.read(node); },
            "where the schema of this format is, for editors"),
        field<D>(
            "name", Text{}, [](D & d) -> auto& { return d.scene.name; }, "name of the scene"),
        field<D>(
            "description", Text{}, [](D & d) -> auto& { return d.scene.description; },
            "what the scene shows"),
        special<D>(
            "settings", reference_to("settings"),
            [](D& d, const Node& n) { read_object(d.scene.settings, n, settings_table()); },
            "how the scene is simulated"),
        special<D>("materials", names_of("material"), read_materials,
                   "materials by name; \"default\" is what bodies have that name none"),
        special<D>("material_pairs", list_of("material_pair"), read_material_pairs,
                   "coefficients of certain pairs of materials"),
        special<D>("shapes", names_of("shape"), read_shapes,
                   "shapes by name, for several bodies to share"),
        special<D>("bodies", list_of("body_entry"), read_bodies,
                   "bodies, and grids, chains and mobiles of them"),
        special<D>("robots", list_of("robot"), read_robots, "robots from URDF files"),
        special<D>("joints", list_of("joint"), read_joints, "joints between bodies"),
        special<D>("couplings", list_of("coupling"), read_couplings,
                   "ties between joints: gears, racks, screws, pulleys"),
        special<D>("deformables", list_of("deformable_entry"), read_deformables,
                   "cloth, balloons, soft solids and ropes, and grids of them"),
        special<D>("links", list_of("link"), read_links,
                   "rods and ropes between points of deformables, bodies and the world"),
        special<D>("view", reference_to("view"), read_view, "where pictures are taken from"),
    };
    return table;
}

}  // namespace plumb::reader

namespace plumb {

Scene parse_scene(std::string_view text, const std::filesystem::path& origin) {
    using namespace reader;
    const Source source{origin.string(), origin.parent_path()};
    const Json json = parse_json(text, source);

    SceneDraft draft;
    if (!origin.stem().empty()) draft.scene.name = origin.stem().string();
    const Node root(json, source);
    draft.materials.add(draft.scene.materials.front().name, 0, root);
    read_object(draft, root, scene_table());
    return std::move(draft.scene);
}

Scene read_scene(const std::filesystem::path& file) {
    if (reader::is_robot(file)) return read_robot(file);
    return parse_scene(reader::text_of_file(file), file);
}

}  // namespace plumb
