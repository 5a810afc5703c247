// SPDX-License-Identifier: BSD-3-Clause
// A geometry that the engine evaluates itself, without a host.
#pragma once

#include <memory>

#include "cad/cad.h"
#include "model/model.h"

namespace carreau {

/// Result of every built-in geometry. The evaluator may be called from several threads at once, and has exact
/// derivatives to order two. The model's faces, curves and points have references and names, and nothing is left to
/// glue. References of faces and of points begin at 1.
struct BuiltGeometry {
  std::shared_ptr<Cad> cad;
  Model model;
};

}  // namespace carreau
