// SPDX-License-Identifier: MIT
/// What is being read of "deformables" and "links".
#pragma once

#include "reader/deformables/deformable_shapes.h"
#include "reader/drafts.h"
#include "scene/element_faults.h"

namespace plumb::reader {

struct DeformableDraft {
    SceneDraft* scene;
    DeformableSpec spec;
    Placement placement;
    std::optional<double> thickness, young, radius;  ///< as the file has them
    std::vector<AttachmentSpec> attachments;         ///< of a deformable without a number yet
    double weight = 1;                               ///< how often a "repeat" deals it
};

/// Fails where so many points more would be too many for a scene.
void require_room(const SceneDraft& draft, double points, const Node& node);

/// A "shape": {"grid": {…}} and so on, for a deformable whose kind is known. Points come in the
/// shape's own frame.
void read_deformable_shape(DeformableDraft& draft, const Node& node);
void add_deformable_shape_definitions(SchemaJson& definitions);

/// "attach", for a deformable whose points are where they belong.
std::vector<AttachmentSpec> read_attachments(SceneDraft& draft, const DeformableSpec& deformable,
                                             const Node& node);
void add_attachment_definitions(SchemaJson& definitions);

/// A file of triangles or tetrahedra: OBJ, Gmsh's .msh or TetGen's .node with its .ele, times a
/// scale. Points that fall together are one.
struct FileElements {
    Elements elements;
    std::size_t merged = 0;             ///< points that fell together with others
    std::vector<std::size_t> inverted;  ///< tetrahedra that stood the other way about than most
};
FileElements read_elements_file(const Node& name, double scale, DeformableKind kind);

/// The part that a fault is about, as near as the file has it; of a deformable also within its
/// shape.
Node place_of(const DeformableFault& fault, const Node& whole);

inline constexpr Range kCoupling{0, 1e15};  ///< compliances and dampings

}  // namespace plumb::reader
