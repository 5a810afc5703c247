// SPDX-License-Identifier: BSD-3-Clause
// Entities of two models that correspond to each other.
#pragma once

#include <vector>

#include "curve/curve_model.h"

namespace carreau {

/// How entities are matched. Values are part of the C ABI.
enum class MatchBy : int {
  any = 0,        ///< references; names or shapes if references do not fit
  reference = 1,  ///< faces and curves of equal references
  name = 2,       ///< faces of equal names
  shape = 3       ///< faces of like neighbours and places in the box of the model
};

/// Counterparts in the new model, by index in the old one.
struct ModelMatch {
  MatchBy by = MatchBy::reference;
  std::vector<int> face;        ///< in Model::faces
  std::vector<int> curve;       ///< in Topology::curves
  std::vector<char> reversed;   ///< by curve: the first uses of both run in opposite directions
};

/// Matches the entities of two models of equal topology. With `any` the references of equal topology must not be twice as far apart as shapes:
/// a CAD system may have renumbered. Throws InvalidModel: an entity without a counterpart, by its reference.
ModelMatch match_models(const CurveModel& from, const CurveModel& to, MatchBy by);

}  // namespace carreau
