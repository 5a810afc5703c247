// SPDX-License-Identifier: BSD-3-Clause
// Several surfaces of triangles in one session.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geometry/discrete/surface.h"

namespace carreau::discrete {

/// A surface, and the reference of its face 1 in the session.
struct PlacedSurface {
  std::shared_ptr<const DiscreteSurface> surface;
  std::int32_t first_face = 1;
};

/// One surface over the triangles of all, whose faces have the references of the session. Vertices of two surfaces at one place become one,
/// so that borders with equal vertices are one line, whose mesh conforms. A triangle that two surfaces share belongs to the first one. Each
/// surface brings its lines: its borders are among them, so nothing is smooth across. `sentences` receives the entities that the last
/// surface shares with the previous ones. A single surface whose faces keep their references is returned unchanged. Throws LimitError where
/// there are too many triangles.
std::shared_ptr<const DiscreteSurface> side_by_side(std::span<const PlacedSurface> given,
                                                    std::vector<std::string>& sentences);

}  // namespace carreau::discrete
