# SPDX-License-Identifier: BSD-3-Clause
# Several sources of one folder are compiled at once: most of the time of a small source goes to the headers that it
# shares with its neighbours. It makes a build from nothing faster and one after an edit slower, so the preset
# for daily work turns it off. Names of unnamed namespaces must differ within a folder, but in sources that stand ALONE.
include_guard()

option(CARREAU_UNITY "Compile several sources of a folder at once" ON)
set(CARREAU_UNITY_SOURCES 25) # at most so many at once: the largest folder

# carreau_unite(<target> [ALONE <source>...]): the sources in C++ that the target has by now, but for some.
function(carreau_unite target)
  if(NOT CARREAU_UNITY)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "ALONE")
  get_target_property(sources ${target} SOURCES)
  get_target_property(here ${target} SOURCE_DIR)
  foreach(source IN LISTS sources)
    if(NOT source MATCHES "\\.cpp$")
      continue()
    endif()
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${here})
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${here} OUTPUT_VARIABLE name)
    if(name IN_LIST ARG_ALONE)
      set_property(GLOBAL APPEND PROPERTY CARREAU_ALONE ${source})
      continue()
    endif()
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${CMAKE_SOURCE_DIR})
    string(MAKE_C_IDENTIFIER "${folder}" folder)
    if(NOT DEFINED count_${folder})
      set(count_${folder} 0)
    endif()
    math(EXPR batch "${count_${folder}} / ${CARREAU_UNITY_SOURCES}")
    math(EXPR count_${folder} "${count_${folder}} + 1")
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${folder}_${batch})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # Clang, unlike GCC, warns of a local name that another source of the group uses in its unnamed namespace.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:Clang>:-Wno-shadow>)
endfunction()
