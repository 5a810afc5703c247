// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/host/host_faults.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <unistd.h>

#include <array>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "base/output_files.h"

namespace command {
namespace {

constexpr int unusable = 2;  // exit status
constexpr int max_frames = 64;
// Recursion without end uses up the stack: the handler needs another stack.
constexpr std::size_t stack_size = 1 << 16;

// Fixed before the handlers are installed, and only read after that.
const void* base = nullptr;  // where the library is loaded
char name[PATH_MAX];         // as it was typed

/// The outermost routine of the library that is being called: null when none is, "" when it has no name.
const char* routine_at_work() noexcept {
  std::array<void*, max_frames> frames{};
  const int n = backtrace(frames.data(), max_frames);
  const char* found = nullptr;
  for (int i = 0; i < n; ++i) {
    Dl_info info{};
    // A call that never returns may be the last of its routine: the address behind it belongs to the next routine.
    const void* const place = static_cast<const char*>(frames[static_cast<std::size_t>(i)]) - 1;
    if (dladdr(place, &info) == 0 || info.dli_fbase != base) continue;
    found = info.dli_sname != nullptr ? info.dli_sname : "";
  }
  return found;
}

void tell(const char* text) noexcept {
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, std::strlen(text));
}

[[noreturn]] void end_because(const char* what, const char* routine, const char* why) noexcept {
  constexpr char of_module[] = "__cad_m_MOD_";
  if (std::strncmp(routine, of_module, sizeof of_module - 1) == 0) routine += sizeof of_module - 1;
  OutputFiles::remove_in_handler();
  for (const char* part : {"carreau: The shared library '", static_cast<const char*>(name), "' ", what,
                           *routine != 0 ? " in " : "", routine, why, ".\n"})
    tell(part);
  _exit(unusable);
}

const char* meaning(int signal) noexcept {
  switch (signal) {
    case SIGSEGV:
      return " (SIGSEGV): it used memory that is not there, or called itself without end";
    case SIGBUS:
      return " (SIGBUS): it used memory that cannot be had";
    case SIGFPE:
      return " (SIGFPE): it divided by zero, or a number was too large";
    case SIGILL:
      return " (SIGILL): it met an instruction that the processor does not know";
    default:
      return " (SIGABRT): it, or a routine that it calls, gave up";
  }
}

extern "C" void on_host_fault(int signal) {
  if (const char* const routine = routine_at_work()) end_because("crashed", routine, meaning(signal));
  std::signal(signal, SIG_DFL);
  raise(signal);
}

extern "C" void on_host_end() {
  const char* const routine = routine_at_work();
  if (routine == nullptr) return;  // the program ends as it should
  std::fflush(nullptr);
  end_because("ended the program", routine, " (exit or STOP)");
}

}  // namespace

void watch_host(const std::string& library, const void* routine) {
  Dl_info info{};
  if (base != nullptr || dladdr(routine, &info) == 0) return;
  std::snprintf(name, sizeof name, "%s", library.c_str());
  base = info.dli_fbase;
  void* frame = nullptr;
  backtrace(&frame, 1);  // loads its libraries now, which a handler must not
  static const auto memory = std::make_unique<char[]>(stack_size);
  stack_t stack{};
  stack.ss_sp = memory.get(), stack.ss_size = stack_size;
  sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_handler = on_host_fault;
  action.sa_flags = SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigaction(signal, &action, nullptr);
  std::atexit(on_host_end);
}

}  // namespace command
