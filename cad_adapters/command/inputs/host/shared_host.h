// SPDX-License-Identifier: BSD-3-Clause
// A geometry in a shared library: the routines of a module cad_m.
#pragma once

#include <carreau.h>

#include <string>

namespace command {

/// Loads a shared library and finds the routines of RT-0232 sec. 3.1 in it. Names are accepted as a C compiler makes
/// them (also bind(C)), as gfortran and ifort name routines of a module cad_m, and as Fortran compilers name external
/// subroutines: surf0, __cad_m_MOD_surf0, cad_m_mp_surf0_, surf0_. The library stays loaded until the program ends,
/// since the runtimes of some languages require it.
class SharedHost {
 public:
  /// `path` as for other files: without a folder it is in the current one. Throws Failure when the library cannot be
  /// loaded, or lacks surf0, curv_int or curv0.
  explicit SharedHost(const std::string& path);

  /// Routines that the library does not have are NULL.
  [[nodiscard]] const carreau_cad_m& routines() const noexcept { return routines_; }

 private:
  carreau_cad_m routines_{};
};

}  // namespace command
