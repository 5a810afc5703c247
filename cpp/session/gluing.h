// References found in space, for hosts that do not know them (RT-0232 sec. 3.2, HDR sec. 4.5.1).
#pragma once

#include <string>
#include <vector>

#include "cad/part_cad.h"
#include "model/model.h"
#include "support/monitor.h"
#include "surface/composite.h"

namespace carreau {

/// The parts of curves that a model uses.
PartCad::Parts parts_of(const Model& model);

struct Gluing {
  double eps = 0;        ///< eps_glue, model length
  double angle_smo = 1;  ///< of supports, degrees
};

/// Gives references to a model without any: cuts curves where curves of other faces end, then glues (model/splits.h,
/// model/topology.h). `supports` are those of the model, before and after. Tells what it has found: a summary, and in
/// detail each pair with its gap and each curve that stays open. `remarks`: as glue(). Throws what the host throws.
Model find_references(const Model& model, ModelSupports& supports, Cad& cad, const Gluing& options,
                      std::vector<std::string>& remarks, Monitor& monitor);

}  // namespace carreau
