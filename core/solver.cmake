# plumb::core: the embeddable library, from math to measure. Eigen, spdlog and threads only.
set(PLUMB_CORE_SOURCES
  math/block_cholesky.cpp math/fill.cpp math/least_degree.cpp math/row_graph.cpp math/sparse_ldlt.cpp
  world/body_row.cpp world/build_joints.cpp world/build_links.cpp world/build_particles.cpp world/build_world.cpp world/derived.cpp
  world/edit_world.cpp world/motion_script.cpp world/shape_store.cpp world/sleep.cpp world/tears.cpp
  schedule/box_tree.cpp schedule/contact_islands.cpp schedule/joint_forest.cpp schedule/joint_trees.cpp schedule/tree_levels.cpp schedule/workers.cpp
  ties/joint_state.cpp ties/tie_list.cpp ties/tie_load.cpp ties/tie_rows.cpp ties/tied_couplings.cpp ties/tied_joints.cpp ties/tied_links.cpp
  kernels/dispatch.cpp
  effects/filter_reachability.cpp effects/plan.cpp
  contacts/bend.cpp contacts/choose_restitution.cpp contacts/contact_faults.cpp contacts/contact_pairs.cpp contacts/contact_reach.cpp
  contacts/contact_room.cpp contacts/detect.cpp contacts/detect_particles.cpp contacts/follow_contacts.cpp contacts/ghost_contacts.cpp
  contacts/ground_touch.cpp contacts/impacts.cpp contacts/match_contacts.cpp contacts/renew_contacts.cpp contacts/reuse_contacts.cpp contacts/rims.cpp
  contacts/still_ground.cpp contacts/surface_detector.cpp
  solve/balloons.cpp solve/contact_stiffness.cpp solve/elastic_contacts.cpp solve/elastic_contacts_load.cpp solve/elastic_factors.cpp
  solve/elastic_parts.cpp solve/elastic_system.cpp solve/elastic_tie_choice.cpp solve/elastic_ties.cpp solve/gaping_joints.cpp solve/impulse_match.cpp
  solve/island_residuals.cpp solve/joint_residual.cpp solve/patch_tree.cpp
  trees/driven_axis.cpp trees/holder_path.cpp trees/joint_closing.cpp trees/tree_energy.cpp trees/tree_holder.cpp trees/tree_nodes.cpp
  trees/tree_path.cpp trees/tree_piece.cpp trees/tree_solver.cpp
  islands/driven_islands.cpp islands/exact_impacts.cpp islands/island_choice.cpp islands/island_closing.cpp islands/island_columns.cpp islands/island_demands.cpp
  islands/island_energy.cpp islands/island_group.cpp islands/island_loan.cpp islands/island_newton.cpp islands/island_obstacles.cpp
  islands/island_residual.cpp islands/island_solver.cpp islands/island_substep.cpp islands/island_system.cpp islands/large_islands.cpp
  step/air.cpp step/break_joints.cpp step/divided_trees.cpp step/fast_joints.cpp step/integrate.cpp step/move_particles.cpp step/move_scripted.cpp
  step/remember_velocities.cpp step/row_solver.cpp step/sleeping.cpp step/step.cpp step/stretched_links.cpp step/tear.cpp step/whirled_trees.cpp
  measure/contact_comparison.cpp measure/contact_patch.cpp measure/deformation.cpp measure/measure.cpp measure/mesh_resolution.cpp
  measure/within_reach.cpp)

# One unit an instruction set; what a processor cannot run is never called (kernels/dispatch.cpp).
plumb_kernel_unit(baseline kernels/unit_baseline.cpp)
list(APPEND PLUMB_CORE_SOURCES "${PLUMB_KERNEL_OBJECT}")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  plumb_kernel_unit(avx2 kernels/unit_avx2.cpp -mavx2)
  list(APPEND PLUMB_CORE_SOURCES "${PLUMB_KERNEL_OBJECT}")
  plumb_kernel_unit(avx512 kernels/unit_avx512.cpp -mavx2 -mavx512f -mavx512dq -mavx512vl -mavx512bw)
  list(APPEND PLUMB_CORE_SOURCES "${PLUMB_KERNEL_OBJECT}")
endif()

# The rows of a substep are one great unit of inlined formulas, which other files only make slower to compile.
set_source_files_properties(step/row_solver.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
add_library(plumb_core STATIC ${PLUMB_CORE_SOURCES})
add_library(plumb::core ALIAS plumb_core)
set_target_properties(plumb_core PROPERTIES EXPORT_NAME core)
target_link_libraries(plumb_core PUBLIC plumb::geometry spdlog::spdlog Threads::Threads PRIVATE $<BUILD_INTERFACE:plumb_options>)
