// SPDX-License-Identifier: BSD-3-Clause
// The check of the host's derivatives before a run.
#pragma once

#include "cad/cad.h"
#include "model/model.h"
#include "surface/options.h"
#include "surface/supports.h"

namespace carreau {

/// Compares the derivatives that the run will use with finite differences at a few points of every face and curve.
/// Throws CallbackError with the first wrong derivative (face, (u, v) or t, both values). Other wrong derivatives are
/// messages; if `known` is given, their faces are left out of it, so that the next run has none of them.
void check_derivatives(const Model& model, const ModelSupports& supports, Cad& cad, const CompositeOptions& options,
                       Model* known, Monitor& monitor);

}  // namespace carreau
