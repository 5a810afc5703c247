// SPDX-License-Identifier: BSD-3-Clause
// Shapes that are hard on a mesher, made by OpenCASCADE's own constructors.
#pragma once

#include <Geom_BSplineSurface.hxx>
#include <TopoDS_Shape.hxx>
#include <functional>
#include <string>
#include <vector>

namespace shapes {

struct NamedShape {
  std::string name;
  std::function<TopoDS_Shape()> make;
  bool forces_slivers = false;  ///< holds a face much narrower than any size of the sweep
};

/// All are solids.
const std::vector<NamedShape>& torture_set();

/// Returns a shape by name; throws std::runtime_error for unknown names.
TopoDS_Shape make(const std::string& name);

/// One B-spline face of degree 1 over [0, 1]^2 whose sides fall by 30 degrees from a ridge at u = 0.25.
Handle(Geom_BSplineSurface) roof();

}  // namespace shapes
