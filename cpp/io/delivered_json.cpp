// SPDX-License-Identifier: BSD-3-Clause
#include "io/delivered_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/element_words.h"
#include "mesh/flat_mesh.h"

namespace carreau {

namespace {

using Json = nlohmann::ordered_json;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

const char* entity_name(EvaluationEntity entity) {
  switch (entity) {
    case EvaluationEntity::edge:
      return "edge";
    case EvaluationEntity::vertex:
      return "vertex";
    default:
      return "triangle";
  }
}

Json histogram(const Histogram& h) {
  Json bounds = Json::array();
  for (std::size_t i = 1; i + 1 < h.bound.size(); ++i) bounds.push_back(number(h.bound[i]));
  return {{"bounds", bounds}, {"counts", h.count}};
}

Json measure(const EvaluatedMeasure& row, const Delivery& one) {
  const Spread& s = one.spread;
  const auto value = [&](double x) { return s.count > 0 ? number(x) : Json(nullptr); };
  return {{"of", entity_name(row.entity)},
          {"count", s.count},
          {"mean", value(s.mean)},
          {"min", value(s.min)},
          {"p1", value(s.p1)},
          {"p99", value(s.p99)},
          {"max", value(s.max)},
          {"limit", number(one.limit)},
          {"beyond", one.beyond},
          {"forced", one.forced},
          {"histogram", histogram(s.histogram)}};
}

Json calls(const CallCounts& c) {
  return {{"surf0", c.surf0}, {"surf1", c.surf1}, {"surf2", c.surf2}, {"curv0", c.curv0},
          {"curv1", c.curv1}, {"curv2", c.curv2}, {"sizes", c.sizes}};
}

Json mesh_counts(const SurfaceMesh& mesh, const MeshEvaluation& delivered) {
  const std::vector<WholeFace> all = whole_faces(mesh);
  const auto failed = std::count_if(all.begin(), all.end(),
                                    [](const WholeFace& each) { return each.face.status == FaceStatus::failed; });
  return {{"faces", all.size()},
          {"failed_faces", failed},
          {"vertices", mesh.vertices.size()},
          {"triangles", delivered.edges.of_triangle.size()},
          {"edges", delivered.edges.vertices.size()},
          {"edges_on_curves", delivered.edges.segments.size()}};
}

/// Faces that are not simply meshed, vanished ones included.
Json other_faces(const SurfaceMesh& mesh) {
  Json list = Json::array();
  for (const WholeFace& each : whole_faces(mesh)) {
    const FlatFace& face = each.face;
    if (face.status == FaceStatus::meshed) continue;
    list.push_back({{"reference", face.ref}, {"name", face.name}, {"status", word_of(face.status)}, {"why", face.why}});
  }
  return list;
}

Json beyond(const SurfaceMesh& mesh, const MeshEvaluation& delivered) {
  Json list = Json::array();
  for (const BeyondInFace& face : beyond_in_faces(mesh, delivered))
    list.push_back({{"reference", face.ref}, {"triangles", face.triangles}, {"worst", number(face.worst)}});
  return list;
}

}  // namespace

std::string delivered_json(const SurfaceMesh& mesh, const CompositeReport& report, const MeshEvaluation& delivered) {
  Json measures = Json::object();
  for (const EvaluatedMeasure& row : delivered_measures()) measures[row.name] = measure(row, delivered[row.kind]);
  Json json = {{"format", "carreau delivered 1"},
                     {"mesh", mesh_counts(mesh, delivered)},
                     {"faces", other_faces(mesh)},
                     {"diag", number(report.diag)},
                     {"measures", measures},
                     {"lengths_in_range", delivered.share_in_range()},
                     {"short_edges", delivered.short_edges},
                     {"long_edges", delivered.long_edges},
                     {"folded_triangles", delivered.folded_triangles},
                     {"beyond_tolerances", beyond(mesh, delivered)},
                     {"not_met", describe(delivered).not_met},
                     {"calls", {{"run", calls(report.calls)}, {"measure", calls(delivered.calls)}}},
                     {"seconds", {{"run", report.seconds_total}, {"measure", delivered.seconds}}}};
  if (const InputDistances& input = delivered.input; std::isfinite(input.bound))
    json["input"] = {{"distance", input.distance},
                     {"bound", input.bound},
                     {"back_distance", input.back_distance},
                     {"back_bound", input.back_bound}};
  return json.dump(2) + "\n";
}

}  // namespace carreau
