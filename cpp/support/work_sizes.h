// SPDX-License-Identifier: BSD-3-Clause
// Amounts of work between two looks for a stop, and for one thread or process. They change no result, only times.
#pragma once

#include <algorithm>
#include <cstddef>

namespace carreau::work_sizes {

/// Between two looks for a stop, well within a tenth of a second: evaluations of a host or integrals; searches in a mesh; steps of a few
/// operations. [MeshPlane.LooksForAStopThroughout, GradedModel.ReportsItsProgressAndStops]
inline constexpr int evaluations = 256, searches = 4096, steps = 1 << 16;
/// Triangles that one thread examines at a time. [tests/cpp/measure: stops]
inline constexpr std::size_t triangles = 1 << 14;
/// Triangles ahead whose data are fetched.
inline constexpr std::size_t prefetched = 12;
/// One place of so many is evaluated by each process, so that different hosts are found: 1.6 % more calls.
inline constexpr std::size_t places_of_one_compared = 64;
/// Places. Below, each process evaluates all places: to wait for the others twice takes longer than a thousand answers that take half a
/// microsecond each.
inline constexpr std::size_t fewest_shared_places = 1024;

/// Rows of a piece when processes share `n` rows: few enough that each of 64 takers has some, and enough that handing them out costs
/// nothing and hosts get batches.
inline constexpr std::size_t piece_of(std::size_t n) noexcept { return std::clamp<std::size_t>(n / 64, evaluations, triangles); }

}  // namespace carreau::work_sizes
