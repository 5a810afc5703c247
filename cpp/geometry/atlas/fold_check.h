// SPDX-License-Identifier: BSD-3-Clause
// Folds of a blended surface.
#pragma once

#include <string>

#include "geometry/atlas/blended_surface.h"

namespace carreau::atlas {

/// Returns a sentence with the place of a fold: the normal is against the planes of the charts. "": there is none. The
/// check divides a grid on each T, narrow strips between knots of phi, and pure zones. The derivative of the normal's
/// area, times a factor of safety, bounds the area inside a cell; a cell without a bound is divided, and after fourteen
/// divisions it counts as a fold.
std::string find_fold(const BlendedSurface& surface);

}  // namespace carreau::atlas
