// SPDX-License-Identifier: BSD-3-Clause
// Messages, progress and the request to stop of a long run.
#pragma once

#include <atomic>
#include <string_view>

#include "support/error.h"

namespace carreau {

/// The current step of a run. Values are part of the C ABI: never renumber.
enum class Phase : int {
  idle = 0,
  model = 1,
  curves = 2,
  patches = 3,
  assembly = 4,
  writing = 5,
  measure = 6,
  gradation = 7
};

/// Importance of a message; a message is delivered when its level <= the verbosity of the run
/// (`verb`, 0..100, RT-0232 sec. 3.3). Values are part of the C ABI.
enum class Level : int { error = 0, warning = 1, summary = 10, detail = 50, debug = 100 };

/// Receives messages and progress, and can request a stop. The base class is silent and never stops.
class Monitor {
 public:
  virtual ~Monitor() = default;

  /// One sentence, without a newline.
  virtual void message(Level /*level*/, std::string_view /*text*/) {}

  /// False if no receiver uses messages of this level: then expensive messages are not composed.
  [[nodiscard]] virtual bool hears(Level /*level*/) const { return true; }

  /// `entity` is the reference of the face or curve at work (0: none), `fraction` in [0, 1] is of
  /// the whole run. Called from the thread that runs. Must return quickly.
  virtual void progress(Phase /*phase*/, int /*entity*/, double /*fraction*/) {}

  /// Sets the stop flag; safe from a callback, another thread or a signal handler.
  void request_stop() noexcept { stop_.store(true, std::memory_order_relaxed); }
  void clear_stop() noexcept { stop_.store(false, std::memory_order_relaxed); }
  [[nodiscard]] bool stop_requested() const noexcept { return stop_.load(std::memory_order_relaxed); }

  /// Every loop that can last longer than some 20 ms calls this at that pace: throws Cancelled if a stop was requested.
  virtual void checkpoint() {
    if (stop_requested()) throw Cancelled("stopped by the host");
  }

 private:
  std::atomic<bool> stop_{false};
};

}  // namespace carreau
