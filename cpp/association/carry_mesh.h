// SPDX-License-Identifier: BSD-3-Clause
// A mesh on the surfaces of another model of equal topology.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "association/match_models.h"
#include "size/size_rules.h"
#include "support/monitor.h"
#include "surface/options.h"
#include "surface/result.h"

namespace carreau {

/// A mesh and its model.
struct MeshOfModel {
  const CurveModel& model;
  const CompositeResult& result;
};

struct CarryReport {
  std::size_t kept = 0, relaxed = 0;  ///< faces whose vertices keep their (u, v), and faces whose vertices were relaxed
  std::size_t smoothed = 0;           ///< faces of which vertices moved, since shapes had fallen much
  std::size_t failed = 0;             ///< faces with triangles that stay turned
};

/// Makes `out.mesh` on the new model with the vertices, triangles and elements of the old mesh. Vertices of curves keep their shares of the length.
/// Vertices of a face keep (u, v) if the boundary does, and else relax harmonically. They move on around triangles whose shapes have fallen much. Elements of second order get new nodes. A face fails if
/// triangles stay turned in (u, v): its reason names the first one. Throws InvalidArgument for meshes without known curves, and the exceptions
/// of both geometries.
CarryReport carry_mesh(const MeshOfModel& from, const CurveModel& to, const ModelMatch& match, const SizeRules& rules,
                       const CompositeOptions& options, Monitor& monitor, CompositeResult& out);

}  // namespace carreau
