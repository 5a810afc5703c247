// SPDX-License-Identifier: BSD-3-Clause
// What a geometry in a shared library does to the process that calls it.
#pragma once

#include <string>

namespace command {

/// From here on a fault or an abort() inside this library, or below it, and an exit() or Fortran's STOP that it calls,
/// end the program with a sentence that names the library and its routine, with status 2 and without a file half
/// written. Other faults end the program as ever. `routine`: the address of any function of it. Once: of two libraries
/// the first one is watched.
void watch_host(const std::string& library, const void* routine);

}  // namespace command
