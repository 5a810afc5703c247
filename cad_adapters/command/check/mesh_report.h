// SPDX-License-Identifier: BSD-3-Clause
// The state of a mesh, beside the figures of carreau_mesh_quality.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "files/mesh_file.h"

namespace command {

struct WorstTriangle {
  std::size_t index = 0;  ///< from 0
  std::int32_t ref = 0;
  double quality = 0;  ///< Q2
  Point centre{};
};

/// A border: a chain of edges that have one triangle.
struct Border {
  std::int64_t edges = 0;
  double length = 0;
  bool closed = false;  ///< a loop
  Point place{};        ///< of one of its vertices
};

struct FaceFigures {
  std::int32_t ref = 0;
  std::string name;
  std::int64_t triangles = 0;
  double area = 0, q2_mean = 0, q2_min = 1, edge_min = 0, edge_mean = 0, edge_max = 0;
};

constexpr int quality_classes = 10;  ///< of 0.1 each; 1 is in the last one

struct MeshReport {
  std::array<std::int64_t, quality_classes> q1{}, q2{};  ///< histograms
  std::vector<WorstTriangle> worst;                      ///< by Q2, lowest first
  std::vector<Border> borders;                           ///< longest first
  std::int64_t edges = 0;
  std::int64_t open_edges = 0;    ///< of one triangle
  std::int64_t loose_edges = 0;   ///< of the mesh's curves, of no triangle
  std::int64_t shared_edges = 0;  ///< of more than two triangles
  std::vector<Point> shared_at;   ///< middles of some of them
  std::int64_t turned_triangles =
      0;                           ///< against most triangles that they are connected with over edges of two triangles
  std::vector<Point> turned_at;    ///< centres of some of them
  std::int64_t folds = 0;          ///< edges inside a face where triangles turn by more than 150 degrees
  std::vector<Point> fold_at;      ///< middles of some of them
  std::int64_t double_points = 0;  ///< vertices at the place of an earlier one, within 1e-9 of the box's diagonal
  std::vector<Point> double_at;    ///< places of some of them
  std::int64_t parts = 0;          ///< of triangles connected over edges
  std::int64_t euler = 0;          ///< used vertices - edges + triangles
  std::vector<FaceFigures> faces;  ///< ascending references
};

/// Edges of curves that no triangle has.
std::vector<std::array<std::int32_t, 2>> loose_edges(const MeshArrays& mesh);

/// Indices must be in range and numbers finite. Lists hold at most `listed` places each; `worst` triangles are listed.
MeshReport report_of(const MeshArrays& mesh, std::size_t worst, std::size_t listed);

}  // namespace command
