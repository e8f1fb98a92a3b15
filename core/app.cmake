# The `plumb` program. It links no back-end: colliders are loaded when it runs.
find_package(CLI11 REQUIRED)
add_executable(plumb_app app/main.cpp app/ablation.cpp app/check.cpp app/check_collider.cpp app/colliders.cpp
  app/compare.cpp app/cost.cpp app/comparison_json.cpp app/comparison_text.cpp
  app/contact_sources.cpp app/distinct_files.cpp
  app/effects.cpp app/energy_watch.cpp app/export.cpp
  app/interrupt.cpp app/joint_watch.cpp app/plugin_path.cpp app/progress.cpp app/recorder.cpp app/residual_watch.cpp app/run.cpp app/run_options.cpp app/statistics.cpp app/study_files.cpp
  app/study_options.cpp app/summary.cpp app/tune.cpp
  app/usage.cpp)
set_target_properties(plumb_app PROPERTIES OUTPUT_NAME plumb)
target_compile_definitions(plumb_app PRIVATE PLUMB_VERSION="${PROJECT_VERSION}")
target_link_libraries(plumb_app PRIVATE plumb::host plumb::reader plumb::output plumb::study nlohmann_json::nlohmann_json CLI11::CLI11
  plumb_options)
