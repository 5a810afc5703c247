// SPDX-License-Identifier: BSD-3-Clause
// Inner edges by which patches would touch each other away from their curves.
#pragma once

#include <optional>
#include <vector>

#include "support/monitor.h"
#include "surface/patch.h"
#include "surface/refine/boundary_refinement.h"

namespace carreau {

class Team;

/// A chord is an inner edge of a patch whose two ends lie on curves, or one end on a seam. Chords that join the same
/// two vertices of space, in one patch or in several, would be one edge of four triangles; one that joins what an edge
/// of a curve joins, an edge of three; one that joins a vertex with itself across a seam, no edge at all; one that
/// joins the two sides of a seam would cut through a surface that it goes round. Each gets a vertex at its middle, on
/// its own surface. Triangles with the same three vertices that are left (all their edges on curves) get a vertex
/// inside. patches[f] is empty for a face that failed. Looks for them with `threads` threads. `team`: of processes each of which
/// has some of the patches only, and all of which call it; null: all are here. Returns the number of new vertices.
std::int64_t separate_chords(const Model& model, const Topology& topology, const RefinedDomains& domains,
                             const std::vector<DiscreteCurve>& curves, Cad& cad,
                             std::vector<std::optional<PatchMesh>>& patches, int threads, Team* team, Monitor& monitor);

}  // namespace carreau
