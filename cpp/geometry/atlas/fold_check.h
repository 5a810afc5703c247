// SPDX-License-Identifier: BSD-3-Clause
// Folds of a blended surface.
#pragma once

#include <string>
#include <vector>

#include "geometry/atlas/blended_surface.h"
#include "geometry/atlas/fold_places.h"

namespace carreau::atlas {

struct FoundFolds {
  std::string first;             ///< a sentence with the place of the first fold; "": there is none
  std::vector<PlaceOfT> places;  ///< for the repair: one of each fold, and a grid on its cell
};

/// A fold is a place where the normal is against the planes of the charts. The check divides a grid on each T, narrow
/// strips between knots of phi and of borders, and pure zones. The derivative of the normal's area, times a factor of safety, bounds
/// the area inside a cell; a cell without a bound is divided, and after fourteen divisions it counts as a fold.
/// If places are not needed, it ends at the first fold.
FoundFolds find_folds(const BlendedSurface& surface, bool needs_places);

}  // namespace carreau::atlas
