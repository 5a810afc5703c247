// SPDX-License-Identifier: BSD-3-Clause
// The faces of a shape, one by one, as a person identifies them.
#pragma once

#include <GeomAbs_SurfaceType.hxx>
#include <array>
#include <string>
#include <vector>

#include "shape_file.h"

namespace carreau_occ {

/// "plane", "cylinder", "B-spline surface", ...
const char* kind_name(GeomAbs_SurfaceType type);

struct FaceFigures {
  int number = 0;
  std::string kind;                     ///< "plane", "cylinder", ...
  double area = 0, perimeter = 0;       ///< 0 where OpenCASCADE fails
  std::array<double, 3> low{}, high{};  ///< its box
};

/// By number. Nothing is thrown.
std::vector<FaceFigures> list_faces(const ShapeFile& file);

}  // namespace carreau_occ
