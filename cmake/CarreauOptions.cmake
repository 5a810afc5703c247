# SPDX-License-Identifier: BSD-3-Clause
# What of OpenCASCADE is linked to libcarreau_cad.
set(CARREAU_OPENCASCADE_LIBRARIES TKXDESTEP TKXDEIGES TKXCAF TKLCAF TKCDF TKSTEP TKSTEPBase TKIGES TKXSBase TKShHealing TKTopAlgo
  TKBRep TKGeomBase TKG3d TKG2d TKMath TKernel)

# What is built. AUTO, the default: where what it needs is found; ON: it must be found. What is left out is told at the end of
# the configuration (carreau_print_summary), with the Debian packages that would bring it.
include(CheckLanguage)
set_property(GLOBAL PROPERTY CARREAU_LEFT_OUT "")

# carreau_left_out(<what is missing> <why>)
function(carreau_left_out what why)
  set_property(GLOBAL APPEND PROPERTY CARREAU_LEFT_OUT "${what}: ${why}")
endfunction()

# carreau_option(<name> <help> <found> <what is missing without it> <why AUTO is OFF>)
function(carreau_option name help found what why)
  set(${name} AUTO CACHE STRING "${help}; AUTO: when what it needs is found")
  set_property(CACHE ${name} PROPERTY STRINGS AUTO ON OFF)
  if(NOT "${${name}}" STREQUAL "AUTO")
    if(NOT ${name})
      carreau_left_out("${what}" "${name} is OFF")
    endif()
  elseif(found)
    set(${name} ON PARENT_SCOPE)
  else()
    set(${name} OFF PARENT_SCOPE)
    carreau_left_out("${what}" "${why}")
  endif()
endfunction()

function(carreau_print_summary)
  get_property(left_out GLOBAL PROPERTY CARREAU_LEFT_OUT)
  if(NOT left_out)
    message(STATUS "Carreau: everything is built")
    return()
  endif()
  message(STATUS "Carreau: left out")
  foreach(line IN LISTS left_out)
    message(STATUS "  ${line}")
  endforeach()
endfunction()

find_package(OpenEXR 3.1 QUIET)
carreau_option(CARREAU_OPENEXR "Fields as OpenEXR images" "${OpenEXR_FOUND}"
  ".exr files" "OpenEXR 3.1 was not found (libopenexr-dev)")
find_package(TBB 2021 QUIET)
carreau_option(CARREAU_TBB "Threads of oneTBB" "${TBB_FOUND}"
  "oneTBB" "it was not found (libtbb-dev), threads of the standard library do its work")
if(PROJECT_IS_TOP_LEVEL)
  find_package(MPI QUIET COMPONENTS C)
  carreau_option(CARREAU_MPI "libcarreau_mpi: meshes by many processes" "${MPI_C_FOUND}"
    "libcarreau_mpi (mpirun carreau mesh)" "MPI was not found (libopenmpi-dev)")
else()
  option(CARREAU_MPI "libcarreau_mpi" OFF)
endif()
if(CARREAU_MPI)
  find_package(MPI REQUIRED COMPONENTS C)
endif()
check_language(Fortran)
carreau_option(CARREAU_FORTRAN "Fortran modules and examples" "${CMAKE_Fortran_COMPILER}"
  "Fortran modules and examples" "there is no Fortran compiler (gfortran)")

# Of a project that contains this one, the library alone.
if(NOT PROJECT_IS_TOP_LEVEL)
  option(CARREAU_OPENCASCADE "libcarreau_cad" OFF)
  option(CARREAU_COMMAND "The command carreau" OFF)
  option(CARREAU_TESTS "Tests" OFF)
  if(CARREAU_OPENCASCADE)
    find_package(OpenCASCADE REQUIRED)
  endif()
  return()
endif()
find_package(OpenCASCADE QUIET) # its package takes exact versions only
carreau_option(CARREAU_OPENCASCADE "libcarreau_cad: CAD files (STEP, IGES, BREP) through OpenCASCADE" "${OpenCASCADE_FOUND}"
  "libcarreau_cad (STEP, IGES and BREP files)" "OpenCASCADE was not found (the libocct packages that README lists)")
if(CARREAU_OPENCASCADE)
  find_package(OpenCASCADE REQUIRED)
endif()
find_package(CLI11 QUIET)
find_package(PNG QUIET)
if(CLI11_FOUND AND PNG_FOUND)
  set(found ON)
else()
  set(found OFF)
endif()
carreau_option(CARREAU_COMMAND "The command carreau" ${found}
  "the command carreau" "CLI11 or libpng was not found (libcli11-dev, libpng-dev)")
if(CARREAU_COMMAND)
  find_library(CARREAU_MUPARSER_LIBRARY muparser DOC "muParser, for --size-map with formulas")
  find_path(CARREAU_MUPARSER_INCLUDE muParser.h DOC "Folder of muParser.h")
  if(CARREAU_MUPARSER_LIBRARY AND CARREAU_MUPARSER_INCLUDE)
    set(found ON)
  else()
    set(found OFF)
  endif()
  carreau_option(CARREAU_MUPARSER "Formulas in carreau mesh --size-map" ${found}
    "formulas in --size-map" "muParser was not found (libmuparser-dev)")
endif()
include(${CMAKE_CURRENT_LIST_DIR}/CarreauPython.cmake)
find_package(GTest QUIET)
find_package(Python3 QUIET COMPONENTS Interpreter)
if(GTest_FOUND AND Python3_Interpreter_FOUND AND CARREAU_OPENEXR AND CARREAU_TBB)
  set(found ON)
else()
  set(found OFF)
endif()
carreau_option(CARREAU_TESTS "Tests" ${found}
  "tests" "they need GoogleTest, Python 3, OpenEXR and oneTBB (libgtest-dev, python3, libopenexr-dev, libtbb-dev)")
