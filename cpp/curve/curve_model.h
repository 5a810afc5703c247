// SPDX-License-Identifier: BSD-3-Clause
// A model's curves with their supports: the input of the curve steps.
#pragma once

#include <span>
#include <vector>

#include "cad/cad.h"
#include "curve/support.h"
#include "model/topology.h"

namespace carreau {

/// References only; everything outlives the steps. supports[face][curve] as in Model::faces.
struct CurveModel {
  const Model& model;
  const Topology& topology;
  const std::vector<std::vector<CurveSupport>>& supports;
  Cad& cad;

  [[nodiscard]] const Curve& curve(int index) const { return topology.curves[static_cast<std::size_t>(index)]; }
  [[nodiscard]] const CurveSupport& support(const CurveUse& use) const {
    return supports[static_cast<std::size_t>(use.face)][static_cast<std::size_t>(use.curve)];
  }
  /// Reference of the face of a use, as the routines of the host expect it.
  [[nodiscard]] int face_ref(const CurveUse& use) const { return model.faces[static_cast<std::size_t>(use.face)].ref; }
  /// Length of the curve in space, defined by its first use.
  [[nodiscard]] double length(int index) const { return support(curve(index).uses.front()).length(); }
};

/// Parameter, in one use, of the point at fraction r of a curve's length (in the direction of the first use).
double parameter_at(const CurveModel& model, const CurveUse& use, double r);

/// Parameters of this point in all uses of a curve.
std::vector<double> parameters_at(const CurveModel& model, int curve, double r);

}  // namespace carreau
