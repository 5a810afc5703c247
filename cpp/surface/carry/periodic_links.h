// SPDX-License-Identifier: BSD-3-Clause
// The pairs of nodes of a periodic mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "curve/discrete_curve.h"
#include "mesh/surface_mesh.h"
#include "model/topology.h"
#include "periodic/periodic_model.h"

namespace carreau {

struct LinkFigures {
  double worst = 0;  ///< largest distance of a node from the image of its partner
  std::size_t faces = 0, nodes_of_faces = 0, curves = 0, nodes_of_curves = 0;
};

/// Lists the pairs of nodes of the mesh, whose slaves are images of their masters (FacePair::flipped is known). `curves`: of the mesh.
LinkFigures link_nodes(const PeriodicModel& periodic, const Topology& topology, const std::vector<DiscreteCurve>& curves, SurfaceMesh& mesh);

}  // namespace carreau
