// SPDX-License-Identifier: BSD-3-Clause
// The domains of the parts of a coarse mesh, with unit edges on the separators between them.
#pragma once

#include <cstdint>
#include <vector>

#include "control_space/control_space.h"
#include "plane/division/coarse_domain.h"
#include "plane/division/partition.h"

namespace carreau::plane {

struct Piece {
  PlaneDomain domain;
  std::vector<std::int32_t> whole;  ///< by vertex of the domain: its number in the whole domain, or, from there on, on separators
  std::vector<std::uint8_t> on_separator;  ///< by vertex of the domain: 1 if it does not belong to the whole domain
  double triangles = 0;                    ///< expected
};

struct Pieces {
  std::vector<Piece> pieces;
  std::vector<Vec2> separators;         ///< vertices on separators that do not belong to the whole domain
  std::vector<std::int32_t> separator;  ///< by vertex of the whole domain, then by vertices on separators: the separator; none, several
  static constexpr std::int32_t none = -1, several = -2;
};

/// `unit`: the metric of the fine mesh; `edge`: units that an edge of the coarse mesh has, about.
Pieces make_pieces(const PlaneDomain& domain, const CoarseDomain& coarse, const CoarseMesh& mesh,
                   const Partition& partition, const ControlSpace& unit, double edge);

}  // namespace carreau::plane
