// SPDX-License-Identifier: BSD-3-Clause
// Pairs of periodic entities of a mesh.
#pragma once

#include <carreau.h>

#include <cstdint>
#include <vector>

namespace command {

/// The arrays of carreau_mesh_periodic.
struct PeriodicPairs {
  std::vector<std::int32_t> dimension, ref;
  std::vector<double> map;
  std::vector<std::int64_t> count;
  std::vector<std::int32_t> node;
};
PeriodicPairs pairs_of(carreau_mesh* mesh);

}  // namespace command
