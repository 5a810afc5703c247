// SPDX-License-Identifier: BSD-3-Clause
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <utility>

#include "support/threads/helpers.h"

// oneTBB is not instrumented, so the thread sanitizer needs to know when it hands work to another thread.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)  // Clang
#define __SANITIZE_THREAD__ 1
#endif
#endif
#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
namespace {
char handed_over;  // its address only
}
#else
#define __tsan_release(address)
#define __tsan_acquire(address)
#endif

namespace carreau {

/// The arena that oneTBB keeps for the calling thread. A worker that waits in an arena for more work, as it does for a
/// while, finds no work in other arenas: with an arena for each run it would come late to the next run.
struct Helpers::State {
  static tbb::task_arena::attach prepared() {
    try {
      tbb::this_task_arena::isolate([] {});  // the first use of oneTBB makes the arena
    } catch (...) {                          // no memory: send() tries again, with an arena of its own
    }
    return {};
  }
  tbb::task_arena arena{prepared()};
};

Helpers::Helpers(int) : state_(std::make_unique<State>()) {}
Helpers::~Helpers() = default;

void Helpers::send(std::function<void()> work) {
  // Does not use a task group: its wait never ends when a task was lost without memory.
  __tsan_release(&handed_over);
  state_->arena.enqueue([work = std::move(work)] {
    __tsan_acquire(&handed_over);  // before anything that was captured is read
    work();
  });
}

std::size_t Helpers::max_threads() noexcept {
  return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

}  // namespace carreau
