// SPDX-License-Identifier: BSD-3-Clause
#include "torn_loops.h"

#include <BRep_Tool.hxx>
#include <Precision.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <map>
#include <tuple>

#include "brep_state.h"

namespace carreau_occ {

namespace {

/// Vertices at which the loops of a face do not go on, ascending.
std::vector<int> loose_ends(const HostFace& face) {
  std::map<int, int> ends;
  for (const HostCurve& curve : face.curves)
    if (!curve.internal) ++ends[curve.end1], ++ends[curve.end2];
  std::vector<int> loose;
  for (const auto& [vertex, count] : ends)
    if (vertex > 0 && count % 2 != 0) loose.push_back(vertex);
  return loose;
}

}  // namespace

void close_torn_loops(std::vector<HostFace>& faces, const TopTools_IndexedMapOfShape& vertices) {
  std::map<int, int> becomes;
  const auto final_of = [&](int vertex) {
    for (auto next = becomes.find(vertex); next != becomes.end(); next = becomes.find(vertex)) vertex = next->second;
    return vertex;
  };
  for (const HostFace& face : faces) {
    if (!face.broken.empty()) continue;
    const std::vector<int> loose = loose_ends(face);
    std::vector<std::tuple<double, int, int>> pairs;  // distance, vertices
    for (std::size_t i = 0; i < loose.size(); ++i)
      for (std::size_t j = i + 1; j < loose.size(); ++j) {
        const TopoDS_Vertex p = TopoDS::Vertex(vertices(loose[i])), q = TopoDS::Vertex(vertices(loose[j]));
        const double distance = BRep_Tool::Pnt(p).Distance(BRep_Tool::Pnt(q));
        if (distance <= BRep_Tool::Tolerance(p) + BRep_Tool::Tolerance(q) + Precision::Confusion())
          pairs.emplace_back(distance, loose[i], loose[j]);
      }
    std::sort(pairs.begin(), pairs.end());
    std::vector<int> joined;
    for (const auto& [distance, p, q] : pairs) {
      if (std::count(joined.begin(), joined.end(), p) + std::count(joined.begin(), joined.end(), q) > 0) continue;
      joined.insert(joined.end(), {p, q});
      const int a = final_of(p), b = final_of(q);
      if (a != b) becomes[std::max(a, b)] = std::min(a, b);
    }
  }
  if (becomes.empty()) return;
  for (HostFace& face : faces)
    for (HostCurve& curve : face.curves) curve.end1 = final_of(curve.end1), curve.end2 = final_of(curve.end2);
}

}  // namespace carreau_occ
