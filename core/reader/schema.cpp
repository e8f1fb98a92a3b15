// SPDX-License-Identifier: MIT
/// The JSON Schema, from the same tables that the reader works by.
#include "reader/drafts.h"

namespace plumb {

std::string scene_schema() {
    using namespace reader;
    SchemaJson definitions = {{"settings", object_schema(settings_table())},
                              {"material", object_schema(material_table())},
                              {"material_pair", object_schema(pair_table())},
                              {"rotation", rotation_definition()}};
    add_shape_definitions(definitions);
    add_body_definitions(definitions);
    add_repeat_definitions(definitions);
    add_chain_definitions(definitions);
    add_mobile_definitions(definitions);
    add_robot_definitions(definitions);
    add_joint_definitions(definitions);
    add_deformable_definitions(definitions);
    add_link_definitions(definitions);
    definitions["view"] = object_schema(view_table());

    SchemaJson schema = {
        {"$schema", "https://json-schema.org/draft/2020-12/schema"},
        {"title", "Plumb scene"},
        {"description", "SI units, y up, world frame. // and /* */ comments are allowed."}};
    schema.update(object_schema(scene_table()));
    schema["$defs"] = definitions;
    return schema.dump(2) + "\n";
}

}  // namespace plumb
