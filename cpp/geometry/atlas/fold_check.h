// SPDX-License-Identifier: BSD-3-Clause
// Folds of a blended surface.
#pragma once

#include <string>

#include "geometry/atlas/blended_surface.h"

namespace carreau::atlas {

/// Returns a sentence with the place of a fold: the normal is against the planes of the charts. "": there is none. The check divides a
/// grid on each T, and the pure zones of moved charts. The derivative of the normal's area, times a factor of safety, bounds the area
/// inside a cell; a cell without a bound is divided, down to 1 / 128 of T. Only folds narrower than that may remain.
std::string find_fold(const BlendedSurface& surface);

}  // namespace carreau::atlas
