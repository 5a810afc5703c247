// SPDX-License-Identifier: BSD-3-Clause
// Many points of a face, a batch at a time.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "cad/cad.h"
#include "support/monitor.h"
#include "support/pieces.h"
#include "support/stepped_tasks.h"

namespace carreau {

/// Points evaluated at a time: enough for hosts that like batches, few enough for a run to stop soon.
inline constexpr std::size_t points_at_once = 512;

/// Evaluates points of the face of reference `face` and calls use(first, uv, jets) for each batch, in order: `first` is
/// the rank of its first point. Looks for a stop before each batch. Throws the host's exceptions, and Cancelled.
template <typename Use>
void for_batches(Cad& cad, int face, unsigned want, std::span<const Vec2> uv, Monitor& monitor, const Use& use) {
  std::vector<SurfaceJet> jets(std::min(points_at_once, uv.size()));
  for_pieces(uv.size(), points_at_once, [&](std::size_t first, std::size_t n) {
    monitor.checkpoint();
    const std::span<SurfaceJet> here = std::span(jets).first(n);
    cad.surface(face, want, uv.subspan(first, n), here);
    use(first, uv.subspan(first, n), std::span<const SurfaceJet>(here));
  });
}

/// Evaluates on up to `threads` threads, which may call the host: batches come in any order, several at a time. Throws
/// the exception of the first batch that fails.
template <typename Use>
void for_batches(Cad& cad, int face, unsigned want, std::span<const Vec2> uv, int threads, Monitor& monitor,
                 const Use& use) {
  constexpr std::size_t at_once = 16 * points_at_once;
  run_each(
      (uv.size() + at_once - 1) / at_once, false, threads,
      [&](std::size_t k, Monitor& of_part) {
        const std::size_t begin = k * at_once, n = std::min(at_once, uv.size() - begin);
        for_batches(cad, face, want, uv.subspan(begin, n), of_part,
                    [&](std::size_t first, std::span<const Vec2> here, std::span<const SurfaceJet> jets) {
                      use(begin + first, here, jets);
                    });
      },
      monitor);
}

}  // namespace carreau
