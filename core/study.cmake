# plumb::study: what accuracy costs in time. Cases with known answers, sweeps over settings, and what they tell.
add_library(plumb_study STATIC study/cases.cpp study/cases/pendulum.cpp)
add_library(plumb::study ALIAS plumb_study)
set_target_properties(plumb_study PROPERTIES EXPORT_NAME study)
target_link_libraries(plumb_study PUBLIC plumb::host PRIVATE $<BUILD_INTERFACE:plumb_options>)
