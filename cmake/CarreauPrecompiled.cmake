# SPDX-License-Identifier: BSD-3-Clause
# Precompiled headers, which halve the time of a build from nothing. They hold headers of other projects only: an edit of
# an own header would build everything again. Sources still include all headers that they use, and -DCARREAU_PCH=OFF
# builds them without precompiled headers.
include_guard()

# ccache takes precompiled headers only with sloppy settings.
set(default ON)
if("${CMAKE_CXX_COMPILER_LAUNCHER};${CMAKE_CXX_COMPILER}" MATCHES "ccache")
  set(default OFF)
endif()
option(CARREAU_PCH "Precompile the headers of the standard library and of other libraries" ${default})

set(CARREAU_STANDARD_HEADERS <algorithm> <array> <atomic> <bit> <cmath> <cstddef> <cstdint> <cstdio> <cstring> <deque>
  <functional> <limits> <map> <memory> <numbers> <numeric> <optional> <set> <span> <stdexcept> <string> <string_view>
  <utility> <variant> <vector>)
# Headers that every source of the engine includes.
set(CARREAU_ENGINE_HEADERS ${CARREAU_STANDARD_HEADERS} <Eigen/Core>)

# carreau_precompile(<target> <header>...): of a target in C++ only.
function(carreau_precompile target)
  if(CARREAU_PCH)
    target_precompile_headers(${target} PRIVATE ${ARGN})
    carreau_silence_false_overflows(${target})
  endif()
endfunction()

# carreau_precompiled_as(<target> <owner>): <target> is compiled with the flags of <owner> and shares its headers.
function(carreau_precompiled_as target owner)
  if(CARREAU_PCH)
    target_precompile_headers(${target} REUSE_FROM ${owner})
    carreau_silence_false_overflows(${target})
  endif()
endfunction()

# GCC 12 reports overflows in std::string's operator+ that do not exist (GCC bug 105651). With precompiled headers it reports
# them although the headers belong to the system. A build without precompiled headers finds overflows of this project.
function(carreau_silence_false_overflows target)
  target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-stringop-overflow>
    $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-stringop-overread>
    $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-array-bounds>)
endfunction()
