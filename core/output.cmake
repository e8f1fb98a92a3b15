# plumb::output: recordings, and what can be made of them.
find_package(ZLIB REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(embree 3 REQUIRED)
find_path(PLUMB_STB_INCLUDE_DIR stb/stb_image_write.h REQUIRED)

# The scripts of pages become strings of the library; building Plumb needs no Node.
set(PLUMB_SCRIPT_SOURCES "")
foreach(name player charts)
  set(script "${CMAKE_CURRENT_SOURCE_DIR}/output/${name}/dist/${name}.min.js")
  set(source "${CMAKE_CURRENT_BINARY_DIR}/${name}_script.cpp")
  add_custom_command(OUTPUT "${source}"
    COMMAND "${CMAKE_COMMAND}" "-DNAME=${name}" "-DSCRIPT=${script}" "-DSOURCE=${source}"
      -P "${CMAKE_CURRENT_SOURCE_DIR}/output/player/embed.cmake"
    DEPENDS "${script}" "${CMAKE_CURRENT_SOURCE_DIR}/output/player/embed.cmake"
    VERBATIM)
  list(APPEND PLUMB_SCRIPT_SOURCES "${source}")
endforeach()

add_library(plumb_output STATIC
  output/chart_files.cpp
  output/chart_script.cpp
  output/chart_stage.cpp
  output/comparison_page.cpp
  output/csv.cpp
  output/deflate.cpp
  output/exporters.cpp
  output/file.cpp
  output/gnuplot.cpp
  output/header_json.cpp
  output/html.cpp
  output/html_deformables.cpp
  output/html_json.cpp
  output/html_page.cpp
  output/motion_code.cpp
  output/particle_code.cpp
  output/particle_motion.cpp
  output/picture.cpp
  output/png.cpp
  output/ray_scene.cpp
  output/recorded_deformable.cpp
  output/recording.cpp
  output/smooth_surface.cpp
  output/study_page.cpp
  output/triangles.cpp
  output/view.cpp
  ${PLUMB_SCRIPT_SOURCES})
add_library(plumb::output ALIAS plumb_output)
set_target_properties(plumb_output PROPERTIES EXPORT_NAME output)
target_link_libraries(plumb_output
  PUBLIC plumb::scene
  PRIVATE $<BUILD_INTERFACE:plumb_options> ZLIB::ZLIB nlohmann_json::nlohmann_json embree
    Threads::Threads)
target_include_directories(plumb_output SYSTEM PRIVATE "${PLUMB_STB_INCLUDE_DIR}")
