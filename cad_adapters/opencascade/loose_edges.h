// SPDX-License-Identifier: BSD-3-Clause
// Edges of a shape that no face has: curves of space, from any thread.
#pragma once

#include <BRepAdaptor_Curve.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shape.hxx>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "evaluators.h"
#include "thread_values.h"

namespace carreau_occ {

/// An edge of no face.
struct LooseEdge {
  TopoDS_Edge edge;
  int number = 0;          ///< in the map of edges, from 1
  int end1 = 0, end2 = 0;  ///< numbers of its vertices where its parameter begins and ends
  double first = 0, last = 1;
};

/// Loose edges of a shape that can be meshed, ascending, by the maps of its edges and vertices. Leaves out edges that
/// have no length, no end or no curve. Files often give each such edge separate vertices. So an end within the
/// tolerances of another vertex gets the smallest number of these vertices, unless both ends would get a vertex that
/// the file keeps apart.
std::vector<LooseEdge> find_loose_edges(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& edges,
                                        const TopTools_IndexedMapOfShape& vertices);

/// Evaluates edges in space. Each thread has its own adaptors, for the reason in evaluators.h.
class LooseCurves {
 public:
  void set(const std::vector<LooseEdge>& edges);
  /// Throws Standard_Failure. `edge` counts from 0; derivatives up to `order`, 0 to 2.
  void evaluate(std::size_t edge, double t, int order, gp_Pnt& p, gp_Vec& d1, gp_Vec& d2);

 private:
  const BRepAdaptor_Curve& mine(std::size_t edge);

  std::vector<TopoDS_Edge> edges_;
  std::vector<Breaks> breaks_;
  ThreadValues<std::vector<std::unique_ptr<BRepAdaptor_Curve>>> of_thread_;
};

}  // namespace carreau_occ
