// SPDX-License-Identifier: BSD-3-Clause
// Several geometries in one model: their references side by side.
#pragma once

#include <vector>

#include "model/model.h"

namespace carreau {

/// The largest references that a model uses or keeps for its geometries; 0: none.
struct LargestReferences {
  int face = 0, curve = 0, point = 0;
};
LargestReferences largest_references(const Model& model);

/// Appends the faces of `part`, an independent geometry, and moves all its references behind the references of `model`;
/// references 0 stay 0. If the references of a geometry are still unknown (needs_gluing), their range is reserved. The
/// new entry of model.geometries is returned. A model that had faces lies in no plane any more. Throws InvalidModel
/// when `part` has no face, has references that no model may have, or makes some larger than an int.
GeometryRange append_geometry(Model& model, Model part);

/// True if the faces belong to more than one geometry.
bool is_mixed(const Model& model);

/// Geometries of a mixed model whose references are still to be found; ascending. The first curve of a geometry
/// decides.
std::vector<int> geometries_to_glue(const Model& model);

/// Faces of one geometry as a separate model, with their references and their indices.
struct GeometryPart {
  Model model;
  std::vector<std::size_t> faces;
};
GeometryPart part_of(const Model& model, int geometry);

/// Moves the references that were found for geometry `part`, from 1, into the room kept for them, or behind all others,
/// and puts its curves in their places.
void put_back(const GeometryPart& part, int geometry, Model& model);

}  // namespace carreau
