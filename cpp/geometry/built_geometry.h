// SPDX-License-Identifier: BSD-3-Clause
// A geometry that the engine evaluates itself, without a host.
#pragma once

#include <memory>

#include "cad/cad.h"
#include "model/model.h"

namespace carreau {

/// What every built-in geometry makes: an evaluator that may be called from several threads at once, with exact
/// derivatives to order two, and a model whose faces, curves and points have references, names and nothing left to
/// glue. References of faces and of points begin at 1.
struct BuiltGeometry {
  std::shared_ptr<Cad> cad;
  Model model;
};

}  // namespace carreau
