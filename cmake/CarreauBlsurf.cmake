# SPDX-License-Identifier: BSD-3-Clause
# carreau_add_blsurf(<target> <source>...)
#
# The program `blsurf` of the manual (INRIA RT-0232, sec. 5) on a module cad_m: compiles the sources, of which one holds
# the module cad_m, with Carreau's blsurf_m and the manual's main program, and links carreau::fortran.
include_guard()

# The source tree, or what a package config has set.
if(NOT CARREAU_FORTRAN_SOURCE_DIR)
  get_filename_component(CARREAU_FORTRAN_SOURCE_DIR "${CMAKE_CURRENT_LIST_DIR}/../cabi/fortran" ABSOLUTE)
endif()
set_property(GLOBAL PROPERTY CARREAU_FORTRAN_SOURCE_DIR "${CARREAU_FORTRAN_SOURCE_DIR}")

function(carreau_add_blsurf target)
  if(NOT ARGN)
    message(FATAL_ERROR "carreau_add_blsurf(${target}): no source with the module cad_m is given")
  endif()
  get_property(dir GLOBAL PROPERTY CARREAU_FORTRAN_SOURCE_DIR)
  add_executable(${target} ${ARGN} "${dir}/blsurf_m.f90" "${dir}/blsurf.f90")
  target_link_libraries(${target} PRIVATE carreau::fortran)
  # Programs with different modules cad_m may be built side by side.
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE Fortran
    Fortran_MODULE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/${target}.modules")
  target_include_directories(${target} PRIVATE "${CMAKE_CURRENT_BINARY_DIR}/${target}.modules")
endfunction()
