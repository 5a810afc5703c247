// SPDX-License-Identifier: BSD-3-Clause
// Looks for places where a blended surface is turned over.
#pragma once

#include "geometry/atlas/blended_surface.h"

namespace carreau::atlas {

/// Throws DomainError with the place of the first fold. Checks the normal against the planes of charts on a grid on each
/// T, and on the pure zones of moved charts. Between the places of the grid the derivative of the normal, times a
/// factor of safety, bounds the change; a cell without a bound is divided, and after the last division it counts as a
/// fold.
void require_no_folds(const BlendedSurface& surface);

}  // namespace carreau::atlas
