// SPDX-License-Identifier: BSD-3-Clause
// Holes, bosses, fillets, chamfers, steps and faces that are smaller than a length.
#pragma once

#include <Message_ProgressRange.hxx>
#include <array>
#include <string>
#include <vector>

#include "shape_file.h"

namespace carreau_occ {

/// A feature of a solid, and the result for it.
struct SmallFeature {
  std::string kind;             ///< "hole", "boss", "fillet", "chamfer", "step", "small face"
  double size = 0;              ///< a diameter of holes and bosses, a radius of fillets, a width of the others
  std::vector<int> faces;       ///< their numbers before anything is removed, ascending
  std::array<double, 3> place;  ///< a point of it
  bool removed = false;
};

/// Finds the features of the solids of a file that are smaller than `size`, without changing it: by kind, then by their
/// first face. A face belongs to one feature at most.
std::vector<SmallFeature> find_small_features(const ShapeFile& file, double size);

/// Removes them kind by kind where OpenCASCADE can extend the faces around (BOPAlgo_RemoveFeatures); others stay. All
/// features of a kind stay when the solids would not stay closed, or when their volume would change by more than the
/// features' areas times `size`. Names, colours and doubts follow. Throws Standard_Failure when OpenCASCADE does.
std::vector<SmallFeature> remove_small_features(ShapeFile& file, double size, const Message_ProgressRange& progress);

}  // namespace carreau_occ
