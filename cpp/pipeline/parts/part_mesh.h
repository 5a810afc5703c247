// SPDX-License-Identifier: BSD-3-Clause
// The part of a mesh that one process keeps when no process has the whole: from its patches to its part, with ghosts.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/flat_mesh.h"
#include "mesh/quality.h"
#include "support/ranks/team.h"
#include "surface/result.h"

namespace carreau {

/// Rows of `mesh`: own triangles first, ascending by their numbers in the whole mesh, then ghosts. Ghosts are triangles of other
/// processes that have an own vertex. Own vertices come first, then vertices of other processes, both ascending.
struct PartMesh {
  int rank = 0, processes = 1;
  FlatMesh mesh;  ///< without faces and fields; edges of curves, each in one of the parts
  std::int64_t own_vertices = 0, own_triangles = 0;
  std::vector<std::int64_t> vertex_number, triangle_number;  ///< in the whole mesh, from 0
  std::vector<std::int32_t> vertex_owner, triangle_owner;    ///< ranks
  std::vector<std::int64_t> vertex_row;  ///< numbers of vertices; each process has consecutive ones

  // Counts of the whole mesh.
  std::int64_t vertices = 0, triangles = 0, curve_edges = 0;
  std::int64_t loose_edges = 0;  ///< the part of them on curves of no face
  std::vector<WholeFace> faces;  ///< with the triangles of all processes
  QualitySummary quality;        ///< sums are rounded otherwise than in one process
  std::int64_t crossings = -1;   ///< pairs of triangles that cross; -1: not searched
  /// Edges for files, by vertices of the whole mesh, with their references: edges of curves without faces, or of all curves. Rank 0
  /// alone has them, and all their number.
  std::int64_t file_edges = 0;
  std::vector<std::array<std::int32_t, 2>> file_edge_vertices;
  std::vector<std::int32_t> file_edge_refs;
  /// Elements other than triangles: the bytes of this process in the file of the whole mesh.
  std::string bytes_of_file;
  std::uint64_t begin_in_file = 0;
};

/// The part of this process of a result in parts (CompositeResult::shares), which is used up. `all_edges`: include the edges of
/// all curves, which files require. All processes call it.
PartMesh make_part(Team& team, CompositeResult result, bool all_edges, int threads);

}  // namespace carreau
