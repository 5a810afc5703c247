// SPDX-License-Identifier: BSD-3-Clause
// Remeshes a piece that deforms, breaks and touches tools (HDR sec. 3.4).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "adapt/estimators.h"
#include "support/monitor.h"
#include "variable/base/piece.h"
#include "variable/boundary/run_curve.h"
#include "variable/boundary/tools.h"

namespace carreau::variable {

/// The transfer of values from one mesh to the next.
enum class FieldKind : int {
  nodal = 0,              ///< at vertices: linear; exact for linear fields
  element_mean = 1,       ///< in triangles: mean over the part that a new triangle covers; exact for constants, bounded
  element_conserved = 2,  ///< in triangles: integrals stay, as densities
};

struct RemeshField {
  std::string name;
  FieldKind kind = FieldKind::nodal;
  int components = 1;
  std::vector<double> values;  ///< vertex by vertex or triangle by triangle, components together
};

/// State in. Lengths are the host's.
struct RemeshInput {
  Piece piece;                     ///< the displacement of the increment already added
  std::vector<Vec2> displacement;  ///< of the increment, by vertex, to be checked; empty: not checked
  std::vector<double> damage;      ///< in [0, 1], by triangle; empty: none
  std::vector<std::int32_t> vertex_kinds;  ///< RemeshResult::vertex_kinds of the last increment: imposed faces stay so; empty: unknown
  std::vector<Tool> tools;         ///< at their current places
  std::vector<RemeshField> fields;

  double h_min = 0, h_max = 0;
  double step = 0;    ///< of the tools in an increment: delta of HDR eq. 3.1; at most h_min
  double reach = -1;  ///< points outside of a tool are bound within this; negative: the step
  double damage_limit = 1;
  double gradation = 1.3;      ///< largest ratio of neighbouring sizes one edge apart
  double corner_angle = 45;    ///< degrees
  double curvature_angle = 8;  ///< between edges and tangents of the boundary, degrees
  bool sizes_by_damage = true;
  bool keep_all_parts = false;
  bool remove_overlaps = false;  ///< elements whose boundary edges cross each other's are removed; else rejected
  Smoothness smoothness = Smoothness::tangent;
  int imposed_smoothing = 0;   ///< rounds
  int error_field = -1;        ///< index of a nodal field of one component, whose interpolation error prescribes sizes
  EstimatorOptions estimator;  ///< the bounds of sizes above are its bounds
  std::int64_t max_triangles = INT64_C(500'000'000);
  bool measure = false;  ///< computes `in_range`
};

/// Agreement of the new boundary with the requested one.
enum class Faithfulness : int {
  smooth = 0,    ///< as asked
  partly = 1,    ///< runs near crossings of new edges keep their nodes
  kept = 2,      ///< all nodes are nodes of the piece, and bound ones have moved to the tools
  as_given = 3,  ///< the boundary is the boundary of the piece
};

/// What happened.
struct RemeshSummary {
  std::int64_t damaged = 0, at_multiple_vertices = 0, dangling = 0, in_parts = 0,
               overlapping = 0;                  ///< triangles removed, by cause
  std::int32_t parts_found = 0, parts_kept = 0;  ///< after the removal
  std::int64_t bound_vertices = 0, free_vertices = 0, imposed_vertices = 0;
  double area_given = 0, area_removed = 0;
  double area_bound = 0;     ///< gained by nodes that moved to tools, were smoothed or removed
  double area_geometry = 0;  ///< inside the new geometry of the boundary; the mesh has its chords
  double area = 0;           ///< of the new mesh
  double in_range = 0;       ///< share of edges whose length in the prescribed size lies in [1/sqrt 2, sqrt 2]
  Faithfulness boundary = Faithfulness::smooth;
};

/// State out.
struct RemeshResult {
  Piece piece;
  std::vector<std::int32_t> vertex_kinds;          ///< enum Kind
  std::vector<std::array<std::int32_t, 2>> edges;  ///< of the boundary, the piece on their left
  std::vector<std::int32_t> edge_kinds;
  std::vector<std::int32_t> parts;  ///< of triangles, from 0
  std::vector<double> damage;       ///< mean over the part that a triangle covers
  std::vector<RemeshField> fields;
  RemeshSummary summary;
};

/// One increment. Deterministic. Throws InvalidArgument for bad input (see check_input, Tools, erode, bind_to_tools),
/// DomainError when the piece overlaps itself, LimitError, Cancelled. The input stays as it is.
RemeshResult remesh(const RemeshInput& input, Monitor& monitor);

/// Throws InvalidArgument for wrong counts or indices, numbers that are not finite, a turned triangle, a displacement
/// or step larger than h_min, damage outside [0, 1], a field of a wrong length, or inconsistent bounds.
void check_input(const RemeshInput& input);

}  // namespace carreau::variable
