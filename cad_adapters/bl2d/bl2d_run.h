// SPDX-License-Identifier: BSD-3-Clause
// One step after another: a domain and sizes to a mesh.
#pragma once

#include "bl2d_env.h"

namespace bl2d {

/// Makes the mesh of each step. Prints a line a step. Throws Failure.
void run(const Env& env);

}  // namespace bl2d
