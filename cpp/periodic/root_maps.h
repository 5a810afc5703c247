// SPDX-License-Identifier: BSD-3-Clause
// The maps of a class that carry its root onto itself.
#pragma once

#include <vector>

#include "periodic/periodic_model.h"

namespace carreau {

/// All but the identity: the image of the root, which is the root, and the map.
std::vector<CurveMember> maps_of_root(const CurveClass& all);

}  // namespace carreau
