// SPDX-License-Identifier: BSD-3-Clause
// Parameters of a run as attributes of the images of its fields.
#pragma once

#include <vector>

#include "io/exr.h"
#include "session/parameters.h"

namespace carreau {

/// "parameter.NAME" of each parameter that a mesh depends on; texts that are empty are left out. `diag`: of defaults
/// that are relative to it; 0: not known, they are NaN.
std::vector<ExrAttribute> field_attributes(const Parameters& parameters, double diag);

}  // namespace carreau
