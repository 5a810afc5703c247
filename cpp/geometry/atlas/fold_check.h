// SPDX-License-Identifier: BSD-3-Clause
// Looks for places where a blended surface is turned over.
#pragma once

#include "geometry/atlas/blended_surface.h"

namespace carreau::atlas {

/// Throws DomainError with the place of a fold: the normal is against the planes of the charts. The check visits a grid
/// on each T, and the pure zones of moved charts. Folds narrower than 1 / 32 of T may remain.
void require_no_folds(const BlendedSurface& surface);

}  // namespace carreau::atlas
