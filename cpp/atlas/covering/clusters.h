// SPDX-License-Identifier: BSD-3-Clause
// A partition of the vertices of a triangulation into clusters that make a well-formed covering (Atlas sec. 5.5).
#pragma once

#include <string>

#include "atlas/covering/frame.h"

namespace carreau::atlas {

/// Cluster of each vertex, from 0, without gaps.
using Partition = std::vector<std::int32_t>;

std::vector<std::vector<std::int32_t>> members_of(const Partition& partition);

/// Clusters around seeds, each a disc with a pure zone. Seeds are `hops` * 2 + 1 edges apart, and a vertex joins the
/// nearest cluster that stays a disc. Most clusters then meet the conditions of a covering; `defects` reports the
/// others. Deterministic.
Partition grown_clusters(const Triangulation& surface, const Fans& fans, int hops);

/// The defect of each cluster that keeps it from being part of a well-formed covering; empty for sound clusters.
/// Regions that are steep or fold count.
std::vector<std::string> defects(const Triangulation& surface, const Fans& fans, const Partition& partition);
/// The defect of one cluster.
std::string defect_of(const Triangulation& surface, const Fans& fans, const Partition& partition,
                      const std::vector<std::int32_t>& members);
/// Penalty of a cluster: 0 without a defect and with a well star-shaped pure zone, larger the farther it is from that.
/// From 1 on it is a defect.
double cluster_badness(const Triangulation& surface, const Fans& fans, const Partition& partition,
                       const std::vector<std::int32_t>& members);

/// Moves vertices between clusters while that makes defects fewer or smaller. Deterministic.
void repair_clusters(const Triangulation& surface, const Fans& fans, Partition& partition);

}  // namespace carreau::atlas
