// SPDX-License-Identifier: BSD-3-Clause
#include "files/periodic_pairs.h"

#include "files/session_handle.h"

namespace command {

PeriodicPairs pairs_of(carreau_mesh* mesh) {
  PeriodicPairs pairs;
  std::int64_t count = 0, nodes = 0;
  require(mesh, carreau_mesh_periodic_count(mesh, &count, &nodes));
  const auto n = static_cast<std::size_t>(count);
  pairs.dimension.resize(n), pairs.ref.resize(2 * n), pairs.node.resize(2 * static_cast<std::size_t>(nodes));
  pairs.map.resize(12 * n), pairs.count.resize(n);
  require(mesh, carreau_mesh_periodic(mesh, count, nodes, pairs.dimension.data(), pairs.ref.data(), pairs.map.data(), pairs.count.data(), pairs.node.data()));
  return pairs;
}

}  // namespace command
