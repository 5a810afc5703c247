// SPDX-License-Identifier: BSD-3-Clause
// Measures of elements of a higher order.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "high_order/high_order_mesh.h"

namespace carreau {

/// Least Jacobians by ElementShape::least_jacobian, as repairs have them.
struct CurvedQuality {
  std::int64_t invalid = 0;
  double least_jacobian_min = 1, least_jacobian_mean = 1;
  double area = 0;
};

CurvedQuality measure_curved(const HighOrderMesh& mesh);

/// Returns one sentence for each invalid element, judged by all of its nodes. Triangles come before quadrilaterals; indices are from 0.
std::vector<std::string> find_curved_defects(const HighOrderMesh& mesh);

}  // namespace carreau
