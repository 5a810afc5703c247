// SPDX-License-Identifier: BSD-3-Clause
// Faults of a geometry in a shared library.
#pragma once

#include <string>

namespace command {

/// From here on a fault, an abort(), an exit() or Fortran's STOP inside this library or below it ends the program with
/// status 2. A sentence names the library and its routine, and no file stays half written. Faults elsewhere end the
/// program as before. `routine`: the address of any function of the library. Call it once: if there are two libraries,
/// the first one is watched.
void watch_host(const std::string& library, const void* routine);

}  // namespace command
