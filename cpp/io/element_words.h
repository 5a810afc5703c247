// SPDX-License-Identifier: BSD-3-Clause
// Words and numbers of formats for kinds of elements and states of faces.
#pragma once

#include "mesh/cells.h"
#include "mesh/surface_mesh.h"

namespace carreau {

/// The name or number that a format has for a kind of elements.
template <typename T>
constexpr T by_kind(CellKind kind, T triangle3, T triangle6, T quad4, T quad8) noexcept {
  if (corner_count(kind) == 3) return is_quadratic(kind) ? triangle6 : triangle3;
  return is_quadratic(kind) ? quad8 : quad4;
}

constexpr const char* word_of(FaceStatus status) noexcept {
  switch (status) {
    case FaceStatus::meshed:
      return "meshed";
    case FaceStatus::mended:
      return "mended";
    case FaceStatus::failed:
      return "failed";
    case FaceStatus::collapsed:
      return "collapsed";
    default:
      return "not meshed";
  }
}

}  // namespace carreau
