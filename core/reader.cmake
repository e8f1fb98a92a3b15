# plumb::reader: scenes from JSON files, robots from URDF files. Its libraries stay private to it.
find_package(nlohmann_json 3.11 REQUIRED)
find_package(tinyobjloader REQUIRED CONFIG)
find_package(urdfdom REQUIRED CONFIG)

add_library(plumb_reader STATIC
  reader/bodies.cpp reader/chain.cpp reader/materials.cpp reader/mobile.cpp reader/names.cpp reader/read_robots.cpp
  reader/reader.cpp reader/repeat.cpp reader/rotation.cpp reader/schema.cpp reader/settings.cpp
  reader/deformables/attachments.cpp reader/deformables/ball.cpp reader/deformables/deformable_shapes.cpp
  reader/deformables/deformables.cpp reader/deformables/element_files.cpp reader/deformables/lattice.cpp
  reader/deformables/links.cpp reader/deformables/plain_shapes.cpp reader/deformables/tube.cpp
  reader/joints/couplings.cpp reader/joints/joint_drives.cpp reader/joints/joint_kinds.cpp reader/joints/joints.cpp
  reader/json/node.cpp reader/json/parse.cpp reader/json/table.cpp reader/json/types.cpp
  reader/meshes/file_text.cpp reader/meshes/gmsh.cpp reader/meshes/obj.cpp reader/meshes/stl.cpp
  reader/meshes/tetgen.cpp
  reader/robots/add_robot.cpp reader/robots/formats.cpp reader/robots/joints.cpp reader/robots/loads.cpp
  reader/robots/shapes.cpp reader/robots/tree.cpp reader/robots/urdf.cpp
  reader/shapes/height_fields.cpp reader/shapes/polyhedra.cpp reader/shapes/read_decompose.cpp
  reader/shapes/read_torus.cpp reader/shapes/shapes.cpp)
add_library(plumb::reader ALIAS plumb_reader)
set_target_properties(plumb_reader PROPERTIES EXPORT_NAME reader)
target_link_libraries(plumb_reader
  PUBLIC plumb::hulls
  PRIVATE $<BUILD_INTERFACE:plumb_options> nlohmann_json::nlohmann_json tinyobjloader::tinyobjloader_double
          urdfdom::urdfdom_model)

# After a change of the format: cmake --build BUILD --target plumb_scene_schema
add_executable(plumb_write_schema EXCLUDE_FROM_ALL reader/write_schema.cpp)
target_link_libraries(plumb_write_schema PRIVATE plumb::reader plumb_options)
add_custom_target(plumb_scene_schema
  COMMAND plumb_write_schema "${CMAKE_CURRENT_SOURCE_DIR}/../samples/schema/plumb-scene.schema.json"
  COMMENT "Writing the schema of scenes")
