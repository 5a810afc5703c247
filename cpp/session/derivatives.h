// The check of the host's derivatives before a run.
#pragma once

#include "cad/cad.h"
#include "model/model.h"
#include "surface/composite.h"

namespace carreau {

/// Compares the derivatives that the run will use with finite differences at a few points of every face and curve.
/// Throws CallbackError with the first wrong one (face, (u, v) or t, both values); the others are messages.
void check_derivatives(const Model& model, const ModelSupports& supports, Cad& cad, const CompositeOptions& options,
                       Monitor& monitor);

}  // namespace carreau
