# plumb_kernel_unit(SOURCE FLAGS…): compiles one kernel unit for its instruction set and makes every symbol but its
# entry tables local, in every build type. Without this the linker could pick a weak template compiled for AVX-512
# for code that runs on any processor. The object's path is returned in PLUMB_KERNEL_OBJECT.
function(plumb_kernel_unit name source)
  add_library(plumb_kernels_${name} OBJECT ${source})
  target_include_directories(plumb_kernels_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(plumb_kernels_${name} PRIVATE plumb_options plumb::interfaces Eigen3::Eigen)
  target_compile_options(plumb_kernels_${name} PRIVATE -O3 -fno-math-errno -fno-trapping-math -Wno-psabi ${ARGN})
  target_compile_definitions(plumb_kernels_${name} PRIVATE EIGEN_DONT_VECTORIZE EIGEN_NO_DEBUG)
  # Of the sanitized units one is enough: the others are the same source at other widths, and slow to build so.
  if(PLUMB_SANITIZE AND NOT name STREQUAL "baseline")
    set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS -fno-sanitize=all)
  endif()
  set(object "${CMAKE_CURRENT_BINARY_DIR}/plumb_kernels_${name}.o")
  add_custom_command(OUTPUT "${object}"
    COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o "${object}" $<TARGET_OBJECTS:plumb_kernels_${name}>
    COMMAND ${CMAKE_OBJCOPY} --wildcard "--keep-global-symbol=*kernel_table*" "${object}"
    DEPENDS plumb_kernels_${name} $<TARGET_OBJECTS:plumb_kernels_${name}>
    COMMAND_EXPAND_LISTS VERBATIM)
  set(PLUMB_KERNEL_OBJECT "${object}" PARENT_SCOPE)
endfunction()
