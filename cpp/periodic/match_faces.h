// SPDX-License-Identifier: BSD-3-Clause
// Which faces the maps of a model carry onto which.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "periodic/curve_images.h"

namespace carreau {

/// A face whose mesh is the image of another face's mesh, or curves alone in the plane.
struct FacePair {
  int master = -1, slave = -1;  ///< indices in Model::faces; -1: there are curves only
  Isometry map;                 ///< of the master onto the slave
  std::map<int, CurveImage> curves = {};  ///< by curve of the master
  bool flipped = false;  ///< found with the meshes: corners a, c, b of the slave's triangles are images of a, b, c
};

/// The pairs of all periodicities of the model, as they are given; of a plane domain the pairs of its curves. `remarks` gets a sentence for each face
/// that a reflection maps onto itself. `diag`: of the model. Throws InvalidModel: faces that do
/// not match, with the distance and the place; unknown faces; maps that change lengths.
std::vector<FacePair> match_faces(const CurveModel& model, double diag, std::vector<std::string>& remarks);

/// How messages call a pair: "faces 3 and 7".
std::string pair_name(const CurveModel& model, const FacePair& pair);

}  // namespace carreau
