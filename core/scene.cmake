# plumb::scene: what the user wrote, as values (headers alone).
add_library(plumb_scene INTERFACE)
add_library(plumb::scene ALIAS plumb_scene)
set_target_properties(plumb_scene PROPERTIES EXPORT_NAME scene)
target_include_directories(plumb_scene INTERFACE
  $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/plumb/core>)
target_link_libraries(plumb_scene INTERFACE plumb::interfaces Eigen3::Eigen)
# Eigen aligns values as the compiler's flags allow. Held at 16 bytes, a Scene is laid out the same in a program that was
# compiled with -march=native as in the installed libraries.
target_compile_definitions(plumb_scene INTERFACE EIGEN_MAX_STATIC_ALIGN_BYTES=16)
