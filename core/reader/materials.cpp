// SPDX-License-Identifier: MIT
/// "materials" and "material_pairs".
#include <algorithm>

#include "reader/drafts.h"

namespace plumb::reader {

namespace {

constexpr Range kFriction{0, 1e6}, kRestitution{0, 1}, kLever{0, 1e3};

bool same_materials(const MaterialPair& p, const MaterialPair& q) {
    return std::minmax(p.a, p.b) == std::minmax(q.a, q.b);
}

void read_between(PairDraft& draft, const Node& node) {
    require_list(node, 2, "names of materials");
    draft.pair.a = draft.scene->materials.find(node.at(0));
    draft.pair.b = draft.scene->materials.find(node.at(1));
}

}  // namespace

const Table<Material>& material_table() {
    using M = Material;
    static const Table<M> table = {
        field<M>("density", Number{kMass}, &M::density, "[kg/m³]"),
        field<M>("friction", Number{kFriction}, &M::friction,
                 "Coulomb's coefficient; a pair has the root of the product"),
        field<M>("restitution", Number{kRestitution}, &M::restitution,
                 "coefficient of restitution; a pair has the greater one"),
        field<M>("rolling_friction", Number{kLever}, &M::rolling_friction,
                 "lever of the torque against rolling [m]"),
        field<M>("spinning_friction", Number{kLever}, &M::spinning_friction,
                 "lever of the torque against spinning about the normal [m]"),
    };
    return table;
}

const Table<PairDraft>& pair_table() {
    using P = PairDraft;
    static const Table<P> table = {
        special<P>(
            "between",
            {{"type", "array"}, {"items", Text{}.schema()}, {"minItems", 2}, {"maxItems", 2}},
            read_between, "names of the two materials", Presence::required),
        field<P>(
            "friction", Number{kFriction}, [](P & p) -> auto& { return p.pair.friction; },
            "Coulomb's coefficient of this pair"),
        field<P>(
            "restitution", Number{kRestitution}, [](P & p) -> auto& { return p.pair.restitution; },
            "coefficient of restitution of this pair"),
        field<P>(
            "rolling_friction", Number{kLever},
            [](P & p) -> auto& { return p.pair.rolling_friction; },
            "lever of the torque against rolling [m]"),
        field<P>(
            "spinning_friction", Number{kLever},
            [](P & p) -> auto& { return p.pair.spinning_friction; },
            "lever of the torque against spinning about the normal [m]"),
    };
    return table;
}

void read_materials(SceneDraft& draft, const Node& node) {
    if (!node.json().is_object()) node.fail_wanting("an object of materials by name");
    auto& materials = draft.scene.materials;
    for (const auto& item : node.json().items()) {
        Material material;
        material.name = item.key();
        read_object(material, node.at(item.key()), material_table());

        // "default" is always there, in front; a scene may change it.
        if (item.key() == materials.front().name) {
            materials.front() = material;
            continue;
        }
        draft.materials.add(material.name, static_cast<std::uint32_t>(materials.size()),
                            node.at(item.key()));
        materials.push_back(material);
    }
}

void read_material_pairs(SceneDraft& draft, const Node& node) {
    if (!node.json().is_array()) node.fail_wanting("a list of pairs of materials");
    auto& pairs = draft.scene.material_pairs;
    for (std::size_t i = 0; i < node.size(); ++i) {
        PairDraft entry{&draft, {}};
        read_object(entry, node.at(i), pair_table());
        for (const MaterialPair& other : pairs) {
            if (same_materials(entry.pair, other))
                node.at(i).fail("this pair of materials stands in the list twice");
        }
        pairs.push_back(entry.pair);
    }
}

}  // namespace plumb::reader
