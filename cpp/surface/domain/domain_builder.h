// SPDX-License-Identifier: BSD-3-Clause
// From discretised curves to the discretised parameter domain of a face.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "curve/discrete_curve.h"
#include "mesh/plane_mesh.h"
#include "model/topology.h"
#include "support/error.h"

namespace carreau {

/// The model's entity under a local vertex of a face.
struct DomainVertexOrigin {
  int curve = -1;   ///< index in Topology::curves of a curve that holds it; -1: an imposed point
  int node = -1;    ///< rank of the vertex on that curve, in the direction of its first use
  int corner = -1;  ///< index in Topology::points when a curve ends here, else -1
  int point = -1;   ///< rank in Face::points of an imposed point, else -1
};

/// The domain of one face, and where its imposed vertices come from.
struct FaceDomain {
  PlaneDomain plane;
  std::vector<DomainVertexOrigin> origin;  ///< of PlaneDomain::vertices
  std::vector<double> size;                ///< prescribed at each vertex of a curve; 0 at imposed points
  std::vector<double> physical;            ///< its physical part
};

/// The side that the orientation gives is not the inside of the discretised boundary. The model is wrong, or its curves
/// are discretised so coarsely that their polygon is inside out.
struct TurnedDomain : DomainError {
  using DomainError::DomainError;
};

/// Curves that vanish between faces which do, and corners that become one with them. Empty lists: no curve vanishes.
struct VanishingCurves {
  std::vector<char> curve;  ///< by index in Topology::curves
  std::vector<int> corner;  ///< by index in Topology::points: the corner that stands for it
};

/// Collects the discretised curves and the imposed points of face `face` (index) and turns its loops so that the
/// surface lies on their left. Ends of curves that meet in the parameter plane become one vertex. Ends that meet in
/// space only (seams) stay two vertices. Throws DomainError naming the face when a loop does not close, TurnedDomain
/// when it is turned the wrong way (HDR fig. 3.1). Vanishing curves are left out, and their ends joined.
FaceDomain build_face_domain(const Model& model, const Topology& topology, std::span<const DiscreteCurve> curves,
                             int face, const VanishingCurves& vanishing = {});

/// Collects the domain with every edge in the direction of its curve, without a check of its loops.
FaceDomain collect_face_domain(const Model& model, const Topology& topology, std::span<const DiscreteCurve> curves,
                               int face);

/// Names a curve of a face in messages: "curve 2 (reference 17)", its rank from 1 and its reference.
std::string curve_name(const Topology& topology, int curve, int face);

/// Positions in space of the domain's vertices that lie on curves (imposed points come last and are left out).
std::vector<Vec3> positions_on_curves(const FaceDomain& domain, const std::vector<DiscreteCurve>& curves,
                                      const Topology& topology);

}  // namespace carreau
