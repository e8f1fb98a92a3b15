# plumb::reader: scenes from JSON files, robots from URDF files. Its libraries stay private to it.
find_package(nlohmann_json 3.11 REQUIRED)
find_package(tinyobjloader REQUIRED CONFIG)
find_package(urdfdom REQUIRED CONFIG)

add_library(plumb_reader STATIC
  reader/bodies.cpp reader/chain.cpp reader/couplings.cpp reader/height_fields.cpp
  reader/joint_drives.cpp reader/joint_kinds.cpp reader/joints.cpp reader/materials.cpp reader/mobile.cpp reader/names.cpp
  reader/node.cpp reader/obj.cpp reader/parse.cpp reader/polyhedra.cpp reader/reader.cpp reader/repeat.cpp
  reader/file_text.cpp reader/read_decompose.cpp reader/read_torus.cpp reader/read_robots.cpp reader/stl.cpp reader/robots/add_robot.cpp reader/robots/formats.cpp reader/robots/joints.cpp reader/robots/loads.cpp
  reader/robots/shapes.cpp reader/robots/tree.cpp reader/robots/urdf.cpp
  reader/attachments.cpp reader/ball.cpp reader/deformable_shapes.cpp reader/deformables.cpp reader/element_files.cpp reader/lattice.cpp
  reader/links.cpp reader/gmsh.cpp reader/plain_shapes.cpp reader/tetgen.cpp reader/tube.cpp
  reader/rotation.cpp reader/schema.cpp reader/settings.cpp reader/shapes.cpp reader/table.cpp reader/types.cpp)
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
