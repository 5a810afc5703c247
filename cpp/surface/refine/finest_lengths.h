// SPDX-License-Identifier: BSD-3-Clause
// Original lengths of the shortest edges at the vertices of curves. Private to surface/.
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "curve/discrete_curve.h"
#include "model/topology.h"
#include "support/infinity.h"

namespace carreau {

/// Lengths in space of the shortest edge at each vertex of discretised curves, at the time of construction. A corner
/// has the shortest edge of all curves that end there. If metrics have directions, three faces at a corner can each
/// find its second edge too long beside its first, for ever. An edge as short as these lengths is therefore no longer
/// cut.
class FinestLengths {
 public:
  FinestLengths(const Topology& topology, const std::vector<DiscreteCurve>& curves) : at_(curves.size()) {
    std::vector<double> at_point(topology.points.size(), infinity);
    const auto bound = [&](int point, double length) { at_point[point] = std::min(at_point[point], length); };
    for (std::size_t c = 0; c < curves.size(); ++c) {
      const DiscreteCurve& d = curves[c];
      const int last = d.segments() - 1;
      for (int k = 0; k < last; ++k) at_[c][d.r[k + 1]] = std::min(length(d, k), length(d, k + 1));
      if (topology.curves[c].degenerate) continue;
      bound(topology.curves[c].end1, length(d, 0));
      bound(topology.curves[c].end2, length(d, last));
    }
    for (std::size_t c = 0; c < curves.size(); ++c) {
      at_[c][curves[c].r.front()] = at_point[topology.curves[c].end1];
      at_[c][curves[c].r.back()] = at_point[topology.curves[c].end2];
    }
  }

  /// Returns whether a segment of a curve is now as short as the shortest edge at one of its ends was. The curve may
  /// have been cut since.
  [[nodiscard]] bool reached_by(const DiscreteCurve& curve, int segment) const {
    double finest = infinity;
    for (const int node : {segment, segment + 1})
      if (const auto known = at_[curve.curve].find(curve.r[node]); known != at_[curve.curve].end())
        finest = std::min(finest, known->second);
    return length(curve, segment) <= finest;
  }

 private:
  static double length(const DiscreteCurve& d, int segment) noexcept {
    return norm(d.xyz[segment + 1] - d.xyz[segment]);
  }
  std::vector<std::map<double, double>> at_;  // [curve][r of a vertex]
};

}  // namespace carreau
