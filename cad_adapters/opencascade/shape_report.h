// SPDX-License-Identifier: BSD-3-Clause
// The content of a shape, and potential meshing problems, before meshing.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "brep_host.h"

namespace carreau_occ {

/// A thing that a mesher may stumble over. Numbers of faces and edges as in BrepHost, 0: not concerned.
struct Danger {
  std::string kind;  ///< "tiny edge", "sliver face", "gap", "free edge", ...
  int face = 0, edge = 0;
  double value = 0;  ///< a length in model units, a number of faces, an angle in degrees, or a common area
  std::string text;  ///< the rest of the sentence
  std::array<int, 2> solids{};  ///< that touch or overlap; 0: not concerned
};

struct ShapeReport {
  int solids = 0, shells = 0, faces = 0, edges = 0, vertices = 0;
  int seams = 0, poles = 0, closed_edges = 0, inner_wires = 0, internal_edges = 0;
  double diagonal = 0, area = 0, volume = 0;  ///< volume of the solids
  double shortest_edge = 0, largest_tolerance = 0, largest_gap = 0;
  std::vector<std::pair<std::string, int>> surfaces;  ///< kinds and how many, by name
  std::vector<Danger> dangers;                        ///< by kind, worst first
};

/// Lists these dangers: edges below `tiny` times the diagonal, and narrower faces; gaps above it between the curve of
/// an edge and its images on the surfaces beside, if they exceed the edge's own tolerance; tolerances above it; bends
/// inside faces (kinks_of); and faces that OpenCASCADE fails on. Costs some ten evaluations an edge. Nothing is thrown.
ShapeReport inspect(const ShapeFile& file, double tiny = 1e-3);

/// Gaps between the curves of edges and their images on the faces beside, at ten places each.
struct Gaps {
  double largest = 0;
  int edge = 0, face = 0;  ///< the place; 0: no gap
  int beyond = 0;          ///< edges with more than twice their own tolerance
};

/// Nothing is thrown; edges that OpenCASCADE fails on are left out.
Gaps measure_gaps(const ShapeFile& file);

/// The faces that bend inside (kinks_of), each with its sharpest bend; by number. Nothing is thrown.
std::vector<Danger> find_kinks(const ShapeFile& file);

}  // namespace carreau_occ
