// SPDX-License-Identifier: BSD-3-Clause
// The ring of triangles around the pure zone of a cluster of vertices, which it shares with other clusters (Atlas sec.
// 5.5).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "atlas/covering/triangulation.h"

namespace carreau::atlas {

/// An edge from a vertex of the cluster to a vertex of another cluster.
struct Spoke {
  std::int32_t inner = 0, outer = 0;
  double phi = 0;  ///< set by the covering
};

/// Triangles that touch a cluster and are not inside it, counterclockwise: triangle k is between spokes k and k + 1.
struct Ring {
  std::vector<Spoke> spokes;
  std::vector<std::size_t> triples;        ///< triangles of three clusters, ascending
  std::vector<std::int32_t> inner_border;  ///< vertices of the pure zone's border, counterclockwise
  std::vector<std::size_t> first_spoke;    ///< of each of them
  std::vector<std::int32_t> outer_border;  ///< of the region
};

/// The ring of a cluster. If the cluster or its region is not a disc, or no three clusters meet beside it, `defect`
/// describes this with a vertex.
Ring ring_of(const Fans& fans, const std::vector<std::int32_t>& cluster, const std::vector<std::int32_t>& members,
             std::string& defect);

}  // namespace carreau::atlas
