// SPDX-License-Identifier: BSD-3-Clause
// What hosts say about one patch that several processes make together: each asks its own at a share of the places.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "support/monitor.h"
#include "support/ranks/team.h"
#include "support/vec.h"

namespace carreau {

/// Asked at places of a patch; what one place gets does not depend on the others.
struct HostQuestion {
  std::string_view step;  ///< of Team::exchange
  std::size_t width = 1;  ///< numbers a place
  int threads = 1;        ///< of each process, that may ask at a time; 1: the calling one
  /// Puts `width` numbers for each place to `out`.
  std::function<void(std::span<const Vec2> uv, double* out, Monitor& monitor)> ask;
};

/// Whether the processes of a team share a question about n places. Null: there is none.
[[nodiscard]] bool is_shared(const Team* team, std::size_t n) noexcept;

/// Answers at all places of the face of reference `ref`, in their order; all processes call it and get the same. Each asks its
/// host at one of 64 places first: throws InvalidModel, which names face and process, where those answers differ, and the error
/// of a process whose host alone fails there. Where all fail, the error is that of one process.
std::vector<double> shared_answers(Team& team, int ref, const HostQuestion& question, std::span<const Vec2> uv,
                                   Monitor& monitor);

/// Throws InvalidModel: the face of reference `ref` is another one in that process than in the first.
[[noreturn]] void refuse_other_face(int ref, std::size_t rank);

}  // namespace carreau
