// SPDX-License-Identifier: BSD-3-Clause
// The curves around a face.
#pragma once

#include <utility>
#include <vector>

#include "cad/cad.h"
#include "curve/support.h"
#include "model/model.h"

namespace carreau::projection {

/// The curves around a face. `supports`: of all its curves.
std::vector<BoundaryCurve> boundary_of(const Face& face, const std::vector<CurveSupport>& supports);
/// The box of the boundary curves in the parameter plane; low > high if there are none.
std::pair<Vec2, Vec2> box_of_boundary(const Face& face, const std::vector<CurveSupport>& supports);
/// True if the boundary is the box.
bool is_box(const Face& face, const std::vector<CurveSupport>& supports, const Vec2& low, const Vec2& high);

}  // namespace carreau::projection
