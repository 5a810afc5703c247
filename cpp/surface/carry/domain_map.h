// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a face as the image of another face's boundary.
#pragma once

#include <string>
#include <vector>

#include "curve/discrete_curve.h"
#include "periodic/match_faces.h"
#include "surface/domain/domain_builder.h"

namespace carreau {

/// Vertices of the slave's domain by vertices of the master's.
struct DomainMap {
  std::vector<int> vertex;
  bool flipped = false;  ///< loops run the other way round: the maps of parameters turn the plane over
  std::string why;       ///< the domains do not correspond; empty: they do
};

/// The domains of a pair whose curves have corresponding vertices. `gap`: model length that images of imposed points may
/// miss.
DomainMap map_domain(const CurveModel& model, const std::vector<DiscreteCurve>& curves, const FacePair& pair,
                     const FaceDomain& master, const FaceDomain& slave, double gap);

}  // namespace carreau
