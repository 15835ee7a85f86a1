# cmake --install: the program, and the library for programs of others (bendlab/README.md).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Our headers include "bendlab/…" and "experiments/…". Both lie below this folder, which is the one to search.
set(headers ${CMAKE_INSTALL_INCLUDEDIR}/bendlab)
# Without those that depend on the compiler's flags, which are ours: the packs and what is made of them.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/lib/bendlab DESTINATION ${headers} FILES_MATCHING PATTERN "*.hpp"
  PATTERN "pack.hpp" EXCLUDE PATTERN "pack_math.hpp" EXCLUDE PATTERN "pack_turn.hpp" EXCLUDE
  PATTERN "element_kernel.hpp" EXCLUDE
  PATTERN "strain_terms.hpp" EXCLUDE PATTERN "models" EXCLUDE PATTERN "methods" EXCLUDE)
if(BENDLAB_PROGRAM)
  foreach(room config measures run campaign terminal)
    install(DIRECTORY ${CMAKE_SOURCE_DIR}/experiments/${room} DESTINATION ${headers}/experiments
      FILES_MATCHING PATTERN "*.hpp")
  endforeach()
  install(FILES ${CMAKE_SOURCE_DIR}/experiments/cli/command_line.hpp DESTINATION ${headers}/experiments/cli)
endif()
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/bendlab)
target_include_directories(bendlab_flags INTERFACE $<INSTALL_INTERFACE:${headers}>)
target_compile_features(bendlab_flags INTERFACE cxx_std_20)

# Eigen aligns memory and small matrices by the flags that it is compiled with. A program that uses the
# library has to do as the library does, whatever its own flags are, and to free what the library allocated.
set(probe ${CMAKE_BINARY_DIR}/eigen_alignment.cpp)
file(WRITE ${probe} "#include <Eigen/Core>\nalignment EIGEN_MAX_ALIGN_BYTES EIGEN_MAX_STATIC_ALIGN_BYTES\n")
get_target_property(eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
separate_arguments(probe_flags UNIX_COMMAND "${CMAKE_CXX_FLAGS}")
if(BENDLAB_NATIVE)
  list(APPEND probe_flags -march=native)
endif()
execute_process(COMMAND ${CMAKE_CXX_COMPILER} ${probe_flags} "-I${eigen}" -E -P ${probe}
  OUTPUT_VARIABLE preprocessed COMMAND_ERROR_IS_FATAL ANY)
if(NOT preprocessed MATCHES "alignment ([0-9]+) ([0-9]+)")
  message(FATAL_ERROR "Eigen's alignment is not known: ${CMAKE_CXX_COMPILER} -E ${probe} gives no number")
endif()
target_compile_definitions(bendlab_flags INTERFACE $<INSTALL_INTERFACE:EIGEN_MAX_ALIGN_BYTES=${CMAKE_MATCH_1}>
  $<INSTALL_INTERFACE:EIGEN_MAX_STATIC_ALIGN_BYTES=${CMAKE_MATCH_2}>
  $<INSTALL_INTERFACE:EIGEN_MALLOC_ALREADY_ALIGNED=0>)
if(CMAKE_MATCH_1 EQUAL 16)  # what malloc() aligns to: the library would use it as it is, a program might not
  target_compile_definitions(bendlab_flags INTERFACE $<BUILD_INTERFACE:EIGEN_MALLOC_ALREADY_ALIGNED=0>)
endif()

set(rooms settings mesh constraints bending effects solver metrics scene flags)
if(BENDLAB_PROGRAM)
  list(APPEND rooms io experiments bench dialects fit)
  set_target_properties(bendlab_program PROPERTIES EXPORT_NAME program)
  set_target_properties(bendlab_cli PROPERTIES EXPORT_NAME bendlab)
  install(TARGETS bendlab_cli bendlab_program EXPORT bendlab)
endif()
foreach(room IN LISTS rooms)
  set_target_properties(bendlab_${room} PROPERTIES EXPORT_NAME ${room})
  install(TARGETS bendlab_${room} EXPORT bendlab)
endforeach()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/bendlab)
install(EXPORT bendlab DESTINATION ${package} NAMESPACE bendlab:: FILE bendlabTargets.cmake)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/bendlabConfig.cmake.in
  ${CMAKE_BINARY_DIR}/bendlabConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/bendlabConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/bendlabConfig.cmake ${CMAKE_BINARY_DIR}/bendlabConfigVersion.cmake
  DESTINATION ${package})
