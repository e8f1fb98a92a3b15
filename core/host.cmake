# plumb::host: plugins by name, and the Simulation facade.
add_library(plumb_host STATIC host/add_bodies.cpp host/choose_collider.cpp host/collider_call.cpp host/collider_library.cpp host/conflicts.cpp
  host/contact_record.cpp host/contact_source.cpp host/cut_short.cpp host/foundation.cpp host/load_plugin.cpp host/log.cpp host/remote_source.cpp
  host/shape_pairs.cpp host/simulation.cpp host/simulation_contacts.cpp host/simulation_edit.cpp host/simulation_log.cpp
  host/guest.cpp host/simulation_cast.cpp host/simulation_names.cpp host/simulation_queries.cpp host/simulation_set.cpp host/simulation_state.cpp
  host/source_proximity.cpp host/watched_collider.cpp host/world_state.cpp)
add_library(plumb::host ALIAS plumb_host)
set_target_properties(plumb_host PROPERTIES EXPORT_NAME host)
target_link_libraries(plumb_host PUBLIC plumb::core ${CMAKE_DL_LIBS} PRIVATE $<BUILD_INTERFACE:plumb_options>)
