# plumb::study: what accuracy costs in time. Cases with known answers, sweeps over settings, and what they tell.
add_library(plumb_study STATIC study/cases.cpp study/two_rods.cpp study/cases/bounces.cpp study/cases/chains.cpp
  study/cases/double_pendulum.cpp study/cases/friction.cpp study/cases/gears.cpp study/cases/parabola.cpp
  study/cases/pendulum.cpp study/cases/rolling.cpp study/cases/springs.cpp study/cases/stack.cpp study/cases/tops.cpp)
add_library(plumb::study ALIAS plumb_study)
set_target_properties(plumb_study PROPERTIES EXPORT_NAME study)
target_link_libraries(plumb_study PUBLIC plumb::host PRIVATE $<BUILD_INTERFACE:plumb_options>)
