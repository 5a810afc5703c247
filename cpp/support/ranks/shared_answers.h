// SPDX-License-Identifier: BSD-3-Clause
// Answers of hosts for one patch that several processes make together: each process evaluates its own host at a share
// of the places.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "support/monitor.h"
#include "support/ranks/executor.h"
#include "support/vec.h"

namespace carreau {

/// A question at places of a patch; the answer at one place does not depend on the others.
struct HostQuestion {
  std::string_view step;  ///< of Team::exchange
  std::size_t width = 1;  ///< numbers a place
  int threads = 1;        ///< of each process, that may call its host at a time; 1: the calling thread
  /// Puts `width` numbers for each place to `out`.
  std::function<void(std::span<const Vec2> uv, double* out, Monitor& monitor)> ask;
};

/// Returns whether several processes share the evaluation of n places.
[[nodiscard]] bool is_shared(const Executor& executor, std::size_t n) noexcept;

/// Answers at all places of the face of reference `ref`, in their order. If processes share them, all call it and get the same; each first
/// evaluates its host at one of 64 places. Throws InvalidModel, which names face and process, if those answers differ. Throws the error of
/// a process whose host alone fails there. If all fail, the error comes from one process.
std::vector<double> shared_answers(const Executor& executor, int ref, const HostQuestion& question, std::span<const Vec2> uv,
                                   Monitor& monitor);

/// Throws InvalidModel: the face of reference `ref` in that process differs from the face in the first.
[[noreturn]] void refuse_other_face(int ref, std::size_t rank);

}  // namespace carreau
