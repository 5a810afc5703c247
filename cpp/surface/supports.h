// SPDX-License-Identifier: BSD-3-Clause
// Supports of all curves of a model.
#pragma once

#include <string>
#include <vector>

#include "curve/support.h"
#include "model/topology.h"
#include "support/monitor.h"

namespace carreau {

/// Supports of every curve of every face, and the diagonal of their box (`diag` of RT-0232).
struct ModelSupports {
  std::vector<std::vector<CurveSupport>> of_face;  ///< [face][curve]
  double diag = 0;
};
/// `threads`: largest number; a host that is not re-entrant is called from the caller's thread only. `failures`: gets,
/// by face, the reason why the host failed on its curves, which are then not complete, or ""; null: the CallbackError
/// is thrown.
ModelSupports build_supports(const Model& model, Cad& cad, double angle_smo, int threads, Monitor& monitor,
                             std::vector<std::string>* failures = nullptr);
CurveTraces traces_of(const ModelSupports& supports);

}  // namespace carreau
