# plumb::geometry: plain geometry, for whoever has shapes (Eigen only).
add_library(plumb_geometry STATIC
  geometry/corner_points.cpp geometry/hills.cpp geometry/mass_properties.cpp geometry/overlap.cpp geometry/shape_support.cpp geometry/solid.cpp)
add_library(plumb::geometry ALIAS plumb_geometry)
set_target_properties(plumb_geometry PROPERTIES EXPORT_NAME geometry)
target_link_libraries(plumb_geometry PUBLIC plumb::scene PRIVATE $<BUILD_INTERFACE:plumb_options>)

# plumb::hulls: what needs qhull beside. Qhull stays private to it.
find_package(Qhull REQUIRED CONFIG)
add_library(plumb_hulls STATIC geometry/decompose.cpp geometry/hull.cpp geometry/torus.cpp)
add_library(plumb::hulls ALIAS plumb_hulls)
set_target_properties(plumb_hulls PROPERTIES EXPORT_NAME hulls)
target_link_libraries(plumb_hulls PUBLIC plumb::geometry PRIVATE $<BUILD_INTERFACE:plumb_options> Qhull::qhull_r)
