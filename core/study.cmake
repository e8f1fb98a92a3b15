# plumb::study: what accuracy costs in time. Cases with known answers, sweeps over settings, and what they tell.
add_library(plumb_study STATIC
  study/cases.cpp study/two_rods.cpp study/cases/bounces.cpp study/cases/chains.cpp study/cases/double_pendulum.cpp
  study/cases/friction.cpp study/cases/gears.cpp study/cases/heaps.cpp study/cases/masonry.cpp study/cases/parabola.cpp study/cases/pendulum.cpp study/cases/robots.cpp study/cases/rolling.cpp
  study/cases/springs.cpp study/cases/stack.cpp study/cases/tops.cpp
  study/cases/balloons.cpp study/cases/beams.cpp study/cases/cloth.cpp study/cases/ropes.cpp
  study/comparison.cpp study/comparison_rows.cpp study/findings.cpp study/free_run.cpp study/gauges.cpp study/journal.cpp study/point.cpp study/run_point.cpp study/self_reference.cpp
  study/study_charts.cpp study/study_json.cpp study/sweep.cpp study/sweep_plan.cpp study/trajectory.cpp study/tune.cpp)
add_library(plumb::study ALIAS plumb_study)
set_target_properties(plumb_study PROPERTIES EXPORT_NAME study)
string(STRIP "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_RELEASE} -ffp-contract=off"
  plumb_flags)
target_compile_definitions(plumb_study PRIVATE PLUMB_VERSION="${PROJECT_VERSION}" "PLUMB_FLAGS=\"${plumb_flags}\"")
target_link_libraries(plumb_study PUBLIC plumb::host
  PRIVATE plumb::reader plumb::output nlohmann_json::nlohmann_json $<BUILD_INTERFACE:plumb_options>)
