// Gradation between the samples of a control space (Borouchaki, Hecht and Frey; HDR sec. 1.1.2).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "metric/metric2.h"
#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// Samples of a field over a parameter plane, joined by triangles; links join samples that no triangle does.
struct SampledField {
  struct Sample {
    Vec2 uv;
    Metric2 metric;
    Metric2 form;  ///< J^T J: lengths in space
  };
  std::vector<Sample> samples;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::array<std::int32_t, 2>> links;
};

/// Shrinks isotropic sizes to the largest that obey: at a corner of a triangle no size exceeds that at any point of the
/// opposite side, along which sizes are linear, by more than `slope` times the distance in space. (Plane fronts are
/// exact, those of one small sample up to 6 % steeper.) Returns the samples that have changed, in increasing order.
/// Linear in the number of samples but for those that change.
std::vector<std::int32_t> bound_slopes(SampledField& field, double slope, Monitor& monitor);

}  // namespace carreau
