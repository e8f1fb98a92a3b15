# plumb_add_plugin(NAME SOURCES… [LINK targets…]): a collision plugin plumb_collider_NAME.so, found by the host in
# PLUMB_PLUGIN_PATH or beside the library (lib/plumb/plugins).
set(PLUMB_PLUGIN_OUTPUT_DIR "${CMAKE_BINARY_DIR}/lib/plumb/plugins" CACHE INTERNAL "")
set(PLUMB_BACKEND_OUTPUT_DIR "${CMAKE_BINARY_DIR}/lib/plumb/backends" CACHE INTERNAL "")  # what plugins load when asked
function(plumb_add_plugin name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(plumb_collider_${name} MODULE ${ARG_SOURCES})
  target_link_libraries(plumb_collider_${name} PRIVATE plumb::interfaces ${ARG_LINK})
  set_target_properties(plumb_collider_${name} PROPERTIES
    PREFIX "" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    LIBRARY_OUTPUT_DIRECTORY "${PLUMB_PLUGIN_OUTPUT_DIR}")
endfunction()
