// SPDX-License-Identifier: BSD-3-Clause
#include "surface/free_elements/element_vertices.h"

#include <utility>

#include "support/infinity.h"

namespace carreau {

WantedSize FreeSurface::wanted_at(std::span<const SurfacePlace> places) const {
  return scaled(charts_.wanted(places), factor_);
}

}  // namespace carreau
