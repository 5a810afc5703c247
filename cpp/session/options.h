// SPDX-License-Identifier: BSD-3-Clause
// Options of a run from the parameters of a session. Private to session/.
#pragma once

#include "session/parameters.h"
#include "surface/options.h"

namespace carreau {

/// `threads`, or, if it is 0, the number that the machine runs at a time.
int threads_of(const Parameters& parameters);

/// failing_faces: a run leaves out faces that fail, and continues.
bool leaves_out(const Parameters& parameters);

/// All but the sources of prescriptions. `diag`: of the model, for values relative to it. Throws InvalidArgument if
/// parameters contradict each other.
CompositeOptions composite_options(const Parameters& parameters, double diag);

}  // namespace carreau
