// SPDX-License-Identifier: BSD-3-Clause
// Names of curves, points and solids, and the solids on both sides of faces, for files that hold groups.
#pragma once

#include <array>
#include <map>
#include <string>

namespace carreau {

/// By reference. Entities of one dimension and one name form a group. Names of faces are in Face.
struct EntityNames {
  std::map<int, std::string> points = {}, curves = {}, solids = {};
  /// For each reference of a face: the solid on the outer side of its triangles, and the solid on the other side; 0:
  /// none.
  std::map<int, std::array<int, 2>> face_solids = {};
};

}  // namespace carreau
