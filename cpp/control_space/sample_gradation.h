// SPDX-License-Identifier: BSD-3-Clause
// Gradation between the samples of a control space (Borouchaki, Hecht and Frey; HDR sec. 1.1.2).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "metric/metric2.h"
#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// First derivatives of a surface.
struct SurfaceTangents {
  Vec3 su{}, sv{};
};

/// Samples of a field over a parameter plane, joined by triangles; links join samples that no triangle joins.
struct SampledField {
  struct Sample {
    Vec2 uv;
    Metric2 metric;
    Metric2 form;                ///< J^T J: lengths in space
    SurfaceTangents tangents{};  ///< source of `form`; not needed by bound_slopes()
  };
  std::vector<Sample> samples;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::array<std::int32_t, 2>> links;
};

/// Shrinks isotropic sizes to the largest that obey the slope. At a corner of a triangle no size exceeds the size at
/// any point of the opposite side by more than `slope` times the distance in space. Sizes are linear along the side.
/// (Plane fronts are exact, fronts of one small sample up to 6 % steeper.) Returns the samples that have changed, in
/// increasing order. Linear in the number of samples, except for the changed ones.
std::vector<std::int32_t> bound_slopes(SampledField& field, double slope, Monitor& monitor);

/// Bounds slopes by direction, as between the places of a graph (size/metric_grading.h). The bounds act from each end
/// of a side to the other, and from the middle of a side to the opposite corner. Sizes grow by the factor 1 + slope d /
/// h, with the distance d and the size h along it at its start. Each size is bounded by the size that belongs to its
/// direction (TangentMetric::matched). Metrics keep their directions, and no size becomes smaller than the smallest of
/// all. Samples where the parametrisation is degenerate neither bound nor change.
std::vector<std::int32_t> bound_slopes_by_direction(SampledField& field, double slope, Monitor& monitor);

}  // namespace carreau
