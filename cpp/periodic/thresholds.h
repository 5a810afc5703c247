// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of periodic faces: meaning, unit, reason, support.
#pragma once

namespace carreau::thresholds::periodic {

// Pairs (match_faces)
/// Share of the model's diagonal by which an image may miss its face. [FacesThatDoNotMatchAreReported]
inline constexpr double max_gap = 1e-4;

}  // namespace carreau::thresholds::periodic
