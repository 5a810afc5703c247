// SPDX-License-Identifier: BSD-3-Clause
// Masters of the vertices of a periodic mesh.
#pragma once

#include <cstddef>
#include <utility>

#include "mesh/flat_mesh.h"
#include "model/union_find.h"

namespace carreau {

/// Adds a field that gives each vertex the first vertex (from 0) of its periodic class, if the mesh has pairs.
inline void add_periodic_masters(FlatMesh& flat) {
  if (flat.periodic.empty()) return;
  UnionFind classes(flat.vertices.size());
  for (const PeriodicLink& link : flat.periodic)
    for (const auto& [slave, master] : link.nodes) classes.merge(static_cast<std::size_t>(slave), static_cast<std::size_t>(master));
  MeshField master{.name = "periodic_master", .on_vertices = true, .components = 1, .values = {}, .edge_values = {}};
  for (std::size_t v = 0; v < flat.vertices.size(); ++v) master.values.push_back(static_cast<double>(classes.find(v)));
  flat.fields.push_back(std::move(master));
}

}  // namespace carreau
