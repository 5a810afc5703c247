// SPDX-License-Identifier: BSD-3-Clause
// Faults inside OpenCASCADE (an illegal memory access or division) as exceptions.
#pragma once

namespace carreau_occ {

/// While one of these lives, SIGSEGV, SIGBUS, SIGFPE and SIGILL that OpenCASCADE raises in a call of this adapter
/// become exceptions of OpenCASCADE (OSD_SIGSEGV, ...). So they end as the error of a face or of a file. For programs
/// that own their process, as the command does: without one, the adapter leaves all signals to the program, and a fault
/// ends it.
/// Several may live at a time; the last one puts back the actions that it found. Signals from other processes, and
/// faults outside OpenCASCADE, get their previous actions.
///
/// OpenCASCADE leaves the place of a fault by longjmp(), as its own OCC_CATCH_SIGNALS does. Memory of its functions is
/// lost, and their locks stay. So a face that faulted is not evaluated again, and a fault in the heap's own routines
/// may still end the program.
class FaultTrap {
 public:
  FaultTrap();
  ~FaultTrap();
  FaultTrap(const FaultTrap&) = delete;
  FaultTrap& operator=(const FaultTrap&) = delete;
};

namespace detail {
void run_guarded(void (*body)(void*), void* data);
}

/// Calls body(). A fault in it is thrown as Standard_Failure while a FaultTrap lives. The objects that `body` itself
/// keeps on its stack are not destroyed then: owning objects belong outside.
template <typename Body>
void guarded(Body&& body) {
  auto call = [&body] { body(); };
  detail::run_guarded([](void* data) { (*static_cast<decltype(call)*>(data))(); }, &call);
}

}  // namespace carreau_occ
