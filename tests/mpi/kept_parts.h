// SPDX-License-Identifier: BSD-3-Clause
// Cases of meshes of which each rank keeps its part.
#pragma once

#include <string>

namespace mpi_tests {

/// False: there is no such case.
bool run_kept_parts(const std::string& name, const std::string& folder);

}  // namespace mpi_tests
