# SPDX-License-Identifier: BSD-3-Clause
# Several sources of one folder are compiled at once: most of the time of a small source goes to the headers that it
# shares with its neighbours. It makes a build from nothing faster and one after an edit slower, so the preset
# for daily work turns it off. Names of unnamed namespaces must differ within a folder, but in sources that stand ALONE.
include_guard()

option(CARREAU_UNITY "Compile several sources of a folder at once" ON)
set(CARREAU_UNITY_SOURCES 25) # at most so many at once: the largest folder

# carreau_unite(<target> [ALONE <source>...] [TOGETHER "<folder or source> ..."...]): the sources in C++ that the target has by now,
# but for some. A string of TOGETHER names folders and sources of one unit, sources of ALONE among them.
function(carreau_unite target)
  if(NOT CARREAU_UNITY)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "ALONE;TOGETHER")
  foreach(places IN LISTS ARG_TOGETHER)
    separate_arguments(places)
    list(GET places 0 first)
    string(MAKE_C_IDENTIFIER "${target}_${first}" unit)
    foreach(place IN LISTS places)
      set("unit_of_${place}" ${unit})
    endforeach()
  endforeach()
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
    endif()
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${here} OUTPUT_VARIABLE room)
    set(unit "${unit_of_${name}}")
    if(NOT unit AND name IN_LIST ARG_ALONE)
      continue()
    elseif(NOT unit)
      set(unit "${unit_of_${room}}")
    endif()
    if(unit)
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${unit})
      continue()
    endif()
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
  # Local names may be those that another source of the unit has in its unnamed namespace.
  target_compile_options(${target} PRIVATE -Wno-shadow
    # GCC collects its garbage once in a large unit, not at each 128 MB.
    $<$<COMPILE_LANG_AND_ID:CXX,GNU>:SHELL:--param ggc-min-heapsize=393216>)
endfunction()
