// SPDX-License-Identifier: BSD-3-Clause
// Faces that a run leaves out (parameter failing_faces).
#pragma once

#include <utility>

#include "cad/cad.h"
#include "model/model.h"
#include "session/parameters.h"
#include "support/error.h"
#include "support/monitor.h"
#include "surface/supports.h"

namespace carreau {

/// Leaves out the faces that a host's failure or a broken rule is about: Face::left_out receives the sentence. False,
/// and nothing has changed, when the error has another cause, is about no face of the model, or about one that is left
/// out already.
bool leave_out(Model& model, const Error& error);
/// Leaves out all faces that break a rule of RT-0232 sec. 3.2, until none does; throws InvalidModel for one that is
/// about no face.
void leave_out_defects(Model& model);

/// The reason why a face has no mesh, with the face in front.
std::string reason_of(int face, const std::string& why);

/// The model as it is meshed: faces that are left out have no curves and no points.
Model without_left_out(const Model& model);
/// That model and its supports. If the parameter requires it, leaves out the faces of `known` whose curves cannot be
/// made. Throws DomainError when no face is left, and CallbackError.
std::pair<Model, ModelSupports> supports_of(Model& known, Cad& whole_cad, double angle_smo,
                                            const Parameters& parameters, Monitor& monitor);
/// Restores in `part`, which may have been glued since, the curves that without_left_out() removed from the faces of
/// `whole`.
void give_back(const Model& whole, Model& part);

}  // namespace carreau
