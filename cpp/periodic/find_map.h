// SPDX-License-Identifier: BSD-3-Clause
// Maps between faces of which only the faces are given.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "model/isometry.h"
#include "support/vec.h"

namespace carreau {

/// Returns the map of least rotation that `accepted` accepts: first the translation between the means of both lists of
/// points, then the motions and at last the reflections that carry three points of `from`, far from each other, to points
/// of `to` at the same distances within `gap`. Empty: none of them.
std::optional<Isometry> find_map(const std::vector<Vec3>& from, const std::vector<Vec3>& to, double gap,
                                 const std::function<bool(const Isometry&)>& accepted);

}  // namespace carreau
