# What `cmake --install` lays down: headers, the libraries an embedder links, plugins, the program, schema and scenes.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(PLUMB_CMAKE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/plumb")
set(PLUMB_PLUGIN_DIR "lib/plumb/plugins")  # as seen from bin/, core/host/collider_library.cpp looks here
set(PLUMB_BACKEND_DIR "lib/plumb/backends")  # beside, plugins/bullet/load_backend.cpp looks here

install(TARGETS plumb_interfaces plumb_scene plumb_geometry plumb_core plumb_host EXPORT plumbTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/interfaces/plumb" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/core/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/plumb/core"
  FILES_MATCHING PATTERN "*.h"
  PATTERN "app" EXCLUDE PATTERN "kernels" EXCLUDE)
# What needs packages beyond those of the solver: find_package(plumb COMPONENTS reader output study).
install(TARGETS plumb_hulls plumb_reader plumb_output plumb_study EXPORT plumbStudyTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(EXPORT plumbStudyTargets NAMESPACE plumb:: DESTINATION "${PLUMB_CMAKE_DIR}")
install(TARGETS plumb_app RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
if(TARGET plumb_check_collider)
  install(TARGETS plumb_check_collider RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
if(PLUMB_BUILD_PLUGINS)
  install(TARGETS plumb_collider_reference plumb_collider_ode plumb_collider_bullet plumb_collider_bullet_float
    plumb_collider_fcl LIBRARY DESTINATION "${PLUMB_PLUGIN_DIR}")
  install(TARGETS plumb_bullet plumb_bullet_float LIBRARY DESTINATION "${PLUMB_BACKEND_DIR}")
endif()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/samples/scenes" "${PROJECT_SOURCE_DIR}/samples/schema"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/plumb")

install(EXPORT plumbTargets NAMESPACE plumb:: DESTINATION "${PLUMB_CMAKE_DIR}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/plumbConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/plumbConfig.cmake" INSTALL_DESTINATION "${PLUMB_CMAKE_DIR}"
  PATH_VARS PLUMB_PLUGIN_DIR)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/plumbConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/plumbConfig.cmake" "${PROJECT_BINARY_DIR}/plumbConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/PlumbPlugin.cmake" DESTINATION "${PLUMB_CMAKE_DIR}")
