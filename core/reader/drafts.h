// SPDX-License-Identifier: MIT
/// What is being read: the scene so far, with its names, and the tables of its objects.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "reader/json/table.h"
#include "reader/reader.h"

namespace plumb::reader {

/// Names of one kind of thing ("material") and the indices that they stand for.
class Names {
public:
    explicit Names(std::string kind) : kind_(std::move(kind)) {}

    /// Adds a name; fails at `node` when it is in use.
    void add(const std::string& name, std::uint32_t index, const Node& node);
    bool has(const std::string& name) const { return indices_.contains(name); }

    /// The index of the name that stands at `node`; fails with the nearest spelling.
    std::uint32_t find(const Node& node) const;

private:
    std::string kind_;
    std::unordered_map<std::string, std::uint32_t> indices_;
};

/// "crate_0007"; of no name, no name.
std::string numbered(const std::string& name, std::size_t number);

struct SceneDraft {
    Scene scene;
    Names materials{"material"}, shapes{"shape"}, bodies{"body"}, joints{"joint"},
        deformables{"deformable"};
    std::size_t points = 0;  ///< of all deformables
};

/// A body, and how often a "repeat" deals it.
struct BodyDraft {
    SceneDraft* scene;
    BodySpec spec;
    double weight = 1;
};

struct PairDraft {
    SceneDraft* scene;
    MaterialPair pair;
};

struct JointDraft {
    SceneDraft* scene;
    JointSpec spec;
    std::optional<Eigen::Vector3d> anchor, axis, second_axis;  // as the file has them
    JointAxisSpec main;                                        ///< "limits" and so on beside "type"
};

struct CouplingDraft {
    SceneDraft* scene;
    CouplingSpec spec;
};

struct ShapeDraft {
    const SceneDraft* scene;
    Geometry geometry;
};

// Tables by the object that they describe.
const Table<Settings>& settings_table();
const Table<Material>& material_table();
const Table<PairDraft>& pair_table();
const Table<ShapeDraft>& shape_table();
const Table<BodyDraft>& body_table();
const Table<JointDraft>& joint_table();
const Table<CouplingDraft>& coupling_table();
const Table<View>& view_table();
const Table<SceneDraft>& scene_table();

/// The $defs of the schema that a file's tables refer to, beside those above.
void add_shape_definitions(SchemaJson& definitions);
void add_body_definitions(SchemaJson& definitions);
void add_repeat_definitions(SchemaJson& definitions);
void add_chain_definitions(SchemaJson& definitions);
void add_mobile_definitions(SchemaJson& definitions);
void add_joint_definitions(SchemaJson& definitions);
void add_coupling_definitions(SchemaJson& definitions);
void add_robot_definitions(SchemaJson& definitions);
void add_deformable_definitions(SchemaJson& definitions);
void add_link_definitions(SchemaJson& definitions);

// Whole parts of a scene.
void read_materials(SceneDraft& draft, const Node& node);
void read_material_pairs(SceneDraft& draft, const Node& node);
void read_shapes(SceneDraft& draft, const Node& node);
void read_bodies(SceneDraft& draft, const Node& node);
void read_robots(SceneDraft& draft, const Node& node);
void read_joints(SceneDraft& draft, const Node& node);
void read_couplings(SceneDraft& draft, const Node& node);
void read_deformables(SceneDraft& draft, const Node& node);
void read_links(SceneDraft& draft, const Node& node);

/// One shape object, {"sphere": {…}}; compounds may name shapes of the scene.
Geometry read_geometry(const SceneDraft& draft, const Node& node);

/// A body with its checks; `prototype` is one that a "repeat" copies, and may have a "weight".
BodyDraft read_body(SceneDraft& draft, const Node& node, bool prototype);

/// Adds a body under its name; fails at `node` when the scene has too many or the name is in use.
void add_body(SceneDraft& draft, BodySpec spec, const Node& node);

/// An entry {"repeat": …, "bodies": …}: bodies on a grid.
void read_repeat(SceneDraft& draft, const Node& node);

/// Entries {"chain": …} and {"mobile": …}: bodies with the joints between them.
void read_chain(SceneDraft& draft, const Node& node);
void read_mobile(SceneDraft& draft, const Node& node);

/// Adds a joint under its name; fails at `node` when the name is in use.
void add_joint(SceneDraft& draft, JointSpec spec, const Node& node);

/// {"axis", "degrees"}, {"quaternion"} or {"euler_degrees"}.
struct Rotation {
    Eigen::Quaterniond read(const Node& node) const;
    SchemaJson schema() const;
};
SchemaJson rotation_definition();

}  // namespace plumb::reader
