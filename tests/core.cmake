# Pieces of the solver one by one, against formulas: a mirror of core/, one program.
plumb_add_tests(plumb_unit_tests unit
  math/anderson_test.cpp math/block_cholesky_test.cpp math/fill_test.cpp math/fnv1a_test.cpp math/free_rotation_test.cpp math/lanes_test.cpp math/least_degree_test.cpp math/logarithm_test.cpp math/pivot_test.cpp math/principal_stretches_test.cpp math/rotation_test.cpp math/root_test.cpp
  math/sparse_ldlt_test.cpp math/symmetric_test.cpp
  scene/deformable_faults_test.cpp scene/joint_faults_test.cpp scene/nearest_test.cpp
  constraints/air_drag_test.cpp constraints/axis_drive_test.cpp constraints/bending_test.cpp constraints/contact_cone_test.cpp constraints/connector_test.cpp
  constraints/elasticity_test.cpp constraints/formulas_test.cpp constraints/joint_rows_test.cpp constraints/rolling_test.cpp constraints/strain_test.cpp
  constraints/tree_block_test.cpp constraints/volume_test.cpp schedule/joint_forest_test.cpp schedule/tree_levels_test.cpp world/slot_map_test.cpp
  geometry/hull_test.cpp geometry/overlap_test.cpp
  effects/filter_reachability_test.cpp effects/plan_test.cpp
  schedule/box_tree_test.cpp schedule/colouring_test.cpp schedule/contact_batches_test.cpp schedule/contact_islands_test.cpp schedule/workers_test.cpp
  measure/contact_comparison_test.cpp measure/deformation_test.cpp measure/mesh_resolution_test.cpp host/choose_collider_test.cpp host/remote_source_test.cpp
  host/edit_bodies_test.cpp host/edit_equal_test.cpp host/edit_errors_test.cpp host/edit_joints_test.cpp
  host/contacts_test.cpp host/log_test.cpp host/names_test.cpp host/state_test.cpp
  contacts/contact_work_test.cpp contacts/facets_test.cpp host/kept_contacts_test.cpp solve/gaping_joints_test.cpp
  islands/island_account_test.cpp islands/island_effort_test.cpp islands/island_solver_test.cpp islands/island_system_test.cpp
  step/residual_test.cpp step/whirled_trees_test.cpp
  host/capture_test.cpp)
# Deformables take the reader's shapes; what frames tell is followed into recordings.
target_link_libraries(plumb_unit_tests PRIVATE plumb::reader plumb::output)
# Their helpers are named as what they test: Random is another class elsewhere, plane() a shape of scenes.
set_source_files_properties(geometry/hull_test.cpp measure/contact_comparison_test.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
