// SPDX-License-Identifier: BSD-3-Clause
#include "base/signals.h"

#include <pthread.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "base/output_files.h"

namespace command {
namespace {

volatile std::sig_atomic_t bar = 0;
pthread_t main_thread;  // set before the first signal is caught

template <std::size_t N>
void tell(const char (&text)[N]) noexcept {
  // Ignores errors: the terminal may be gone.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, N - 1);
}

// Only files under way outlive the process, so that the handler ends it at once: also while OpenCASCADE reads for
// seconds, or in a host's routine. Calls only functions that POSIX allows in a handler.
extern "C" void end_now(int signal) {
  // A signal that waits in the main thread, where files get their names, would run in any other thread.
  if (pthread_equal(pthread_self(), main_thread) == 0) {
    pthread_kill(main_thread, signal);
    return;
  }
  const WrittenFiles written = OutputFiles::remove_in_handler();
  if (bar != 0) tell("\r\033[K");
  if (written == WrittenFiles::all)
    tell("stopped; the files are written\n");
  else if (written == WrittenFiles::some)
    tell("stopped; not all files are written\n");
  else
    tell("stopped; nothing was written\n");
  std::signal(signal, SIG_DFL);
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, signal);
  pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
  raise(signal);
  _exit(128 + signal);
}

}  // namespace

void catch_signals() {
  main_thread = pthread_self();
  struct sigaction action {};
  action.sa_handler = end_now;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&action.sa_mask, signal);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old {};
    // A program in the background goes on.
    if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

void bar_is_shown(bool shown) noexcept { bar = shown ? 1 : 0; }

}  // namespace command
