// SPDX-License-Identifier: BSD-3-Clause
#include "session/bounds_of_sizes.h"

#include <algorithm>

#include "metric/metric3_algebra.h"

namespace carreau {

SizeRange range_of(const VertexPrescriptions& prescriptions) {
  SizeRange range;
  for (const double h : prescriptions.sizes) {
    range.low = std::min(range.low, h);
    range.high = std::max(range.high, h);
  }
  // Across the surface a metric has the smaller of its two sizes.
  for (const Metric3& m : prescriptions.metrics) {
    const Eigen3 e = eigen(m);
    range.low = std::min(range.low, 1 / std::sqrt(e.value[0]));
    range.high = std::max(range.high, 1 / std::sqrt(e.value[2]));
    range.stretch = std::max(range.stretch, std::sqrt(e.value[0] / e.value[2]));
  }
  return range;
}

OpenBounds::OpenBounds(Parameters& parameters, SizeRange range) : parameters_(parameters) {
  open("hphymin", range.low * (1 - 1e-12));
  open("hphymax", range.high * (1 + 1e-12));
}

OpenBounds::~OpenBounds() {
  for (const char* name : opened_) parameters_.reset(name);
}

void OpenBounds::open(const char* name, double value) {
  if (parameters_.is_set(name)) return;
  parameters_.set(name, value);
  opened_.push_back(name);
}

}  // namespace carreau
