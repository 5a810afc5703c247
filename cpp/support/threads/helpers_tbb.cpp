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

struct Helpers::State {
  explicit State(int threads) : arena(threads, 1) {}
  tbb::task_arena arena;  // of the calling thread and its helpers
};

Helpers::Helpers(int threads) : state_(std::make_unique<State>(threads)) {}
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
