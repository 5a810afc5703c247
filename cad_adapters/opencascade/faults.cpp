// SPDX-License-Identifier: BSD-3-Clause
// Standard_ErrorHandler.hxx activates OCC_CATCH_SIGNALS only with this macro.
#if !defined(OCC_CONVERT_SIGNALS)  // its packages define it for some configurations
#define OCC_CONVERT_SIGNALS
#endif
#include "faults.h"

#include <OSD_SIGBUS.hxx>
#include <OSD_SIGILL.hxx>
#include <OSD_SIGSEGV.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_NumericError.hxx>
#include <array>
#include <atomic>
#include <cfenv>
#include <csignal>
#include <memory>
#include <mutex>

namespace carreau_occ {
namespace {

constexpr std::array trapped{SIGSEGV, SIGBUS, SIGFPE, SIGILL};

// Actions of signals belong to the process, and so do these variables.
std::mutex mutex;
int traps = 0;                                     // guarded by the mutex
std::atomic<bool> active{false};                   // traps > 0
std::array<struct sigaction, trapped.size()> old;  // written while no fault is trapped

/// Recursion without end uses up the stack: the handler needs another stack.
class HandlerStack {
 public:
  HandlerStack() {
    stack_t found{};
    if (sigaltstack(nullptr, &found) != 0 || (found.ss_flags & SS_DISABLE) == 0) return;  // another stack is set
    memory_ = std::make_unique<char[]>(size);
    stack_t own{};
    own.ss_sp = memory_.get(), own.ss_size = size;
    if (sigaltstack(&own, nullptr) != 0) memory_.reset();
  }
  ~HandlerStack() {
    if (!memory_) return;
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    sigaltstack(&none, nullptr);
  }
  HandlerStack(const HandlerStack&) = delete;
  HandlerStack& operator=(const HandlerStack&) = delete;

 private:
  static constexpr std::size_t size = 1 << 16;  // the handler makes a string and jumps
  std::unique_ptr<char[]> memory_;
};

Handle(Standard_Failure) failure_of(int signal) {
  switch (signal) {
    case SIGSEGV:
      return OSD_SIGSEGV::NewInstance("it read or wrote memory that is not there, or called itself without end");
    case SIGBUS:
      return OSD_SIGBUS::NewInstance("it read or wrote memory that cannot be had");
    case SIGILL:
      return OSD_SIGILL::NewInstance("it met an instruction that the processor does not know");
    default:
      return Standard_NumericError::NewInstance("it divided by zero, or a number was too large");
  }
}

extern "C" void on_fault(int signal, siginfo_t* info, void* context) {
  // A positive code comes from the processor, not from a kill(). OpenCASCADE's list of handlers knows if the thread has
  // a place to jump to; if so, this does not return.
  if (info->si_code > 0 && Standard_ErrorHandler::IsInTryBlock()) failure_of(signal)->Jump();
  std::size_t i = 0;
  while (trapped[i] != signal) ++i;
  const struct sigaction& action = old[i];
  if ((action.sa_flags & SA_SIGINFO) != 0) {
    action.sa_sigaction(signal, info, context);
  } else if (action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN) {
    action.sa_handler(signal);
  } else {
    sigaction(signal, &action, nullptr);
    if (info->si_code <= 0) raise(signal);  // a fault comes again by itself
  }
}

}  // namespace

FaultTrap::FaultTrap() {
  const std::scoped_lock lock(mutex);
  if (traps++ > 0) return;
  struct sigaction action {};
  action.sa_sigaction = on_fault;
  // The handler is left by a jump, so that the signal must not be blocked in it.
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < trapped.size(); ++i) sigaction(trapped[i], nullptr, &old[i]);
  for (const int signal : trapped) sigaction(signal, &action, nullptr);
  active = true;
}

FaultTrap::~FaultTrap() {
  const std::scoped_lock lock(mutex);
  if (--traps > 0) return;
  active = false;
  for (std::size_t i = 0; i < trapped.size(); ++i) sigaction(trapped[i], &old[i], nullptr);
}

namespace detail {

void run_guarded(void (*body)(void*), void* data) {
  if (!active) {
    body(data);
    return;
  }
  thread_local const HandlerStack stack;
  // The system enters a handler with the processor's default traps and rounding. A whole environment would take longer
  // to read than most calls take.
  const int rounding = std::fegetround(), traps = fegetexcept();
  try {
    OCC_CATCH_SIGNALS
    body(data);
  } catch (const Standard_Failure&) {
    std::fesetround(rounding);
    std::feclearexcept(FE_ALL_EXCEPT);  // traps must not be pending
    fedisableexcept(FE_ALL_EXCEPT);
    feenableexcept(traps);
    throw;
  }
}

}  // namespace detail
}  // namespace carreau_occ
