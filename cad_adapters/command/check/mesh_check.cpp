// SPDX-License-Identifier: BSD-3-Clause
#include "check/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "check/quality_json.h"

namespace command {
namespace {

using Json = nlohmann::ordered_json;

/// True if indices are in range and coordinates finite.
bool can_be_measured(const MeshArrays& mesh) {
  const auto n = static_cast<std::int32_t>(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (const std::int32_t v : t)
      if (v < 0 || v >= n) return false;
  for (const Point& p : mesh.vertices)
    for (const double x : p)
      if (!std::isfinite(x)) return false;
  return true;
}

Json json_of(const MeshReport& r) {
  Json borders = Json::array(), faces = Json::array(), worst = Json::array();
  for (const Border& b : r.borders)
    borders.push_back({{"edges", b.edges}, {"length", b.length}, {"loop", b.closed}, {"at", b.place}});
  for (const FaceFigures& f : r.faces)
    faces.push_back({{"reference", f.ref},
                     {"name", f.name},
                     {"triangles", f.triangles},
                     {"area", f.area},
                     {"q2_mean", f.q2_mean},
                     {"q2_min", f.q2_min},
                     {"edge_min", f.edge_min},
                     {"edge_mean", f.edge_mean},
                     {"edge_max", f.edge_max}});
  for (const WorstTriangle& t : r.worst)
    worst.push_back({{"triangle", t.index}, {"reference", t.ref}, {"q2", t.quality}, {"at", t.centre}});
  return {{"q1_classes", r.q1},
          {"q2_classes", r.q2},
          {"worst", worst},
          {"parts", r.parts},
          {"euler", r.euler},
          {"borders", borders},
          {"loose_edges", r.loose_edges},
          {"shared_edges", {{"count", r.shared_edges}, {"at", r.shared_at}}},
          {"turned_triangles", {{"count", r.turned_triangles}, {"at", r.turned_at}}},
          {"folds", {{"count", r.folds}, {"at", r.fold_at}}},
          {"double_points", {{"count", r.double_points}, {"at", r.double_at}}},
          {"faces", faces}};
}

/// Other elements than straight triangles, of which all has been measured.
bool holds_elements(carreau_mesh* mesh) {
  for (const std::int32_t kind : {CARREAU_CELL_QUAD8, CARREAU_CELL_QUAD4, CARREAU_CELL_TRIANGLE6}) {
    std::int64_t n = 0;
    require(mesh, carreau_mesh_cell_count(mesh, kind, &n));
    if (n > 0) return true;
  }
  return false;
}

/// The shape figures of the mesh itself.
void ask_shapes(carreau_mesh* mesh, const std::vector<std::int32_t>& refs, const Crossings* known, MeshCheck& c) {
  c.quality.struct_size = sizeof c.quality;
  require(mesh, carreau_mesh_quality(mesh, &c.quality));
  c.cells.struct_size = sizeof c.cells;
  require(mesh, carreau_mesh_order(mesh, &c.order));
  if (holds_elements(mesh)) require(mesh, carreau_mesh_cell_quality(mesh, &c.cells));
  c.crossings = known != nullptr ? *known : crossings_of(mesh, refs, 0);
}

/// All but that.
MeshCheck look_at(carreau_mesh* mesh, const MeshArrays& arrays, const CheckLimits& limits) {
  constexpr std::size_t places = 5;  // of each thing that is wrong
  MeshCheck c;
  require(mesh, carreau_mesh_count(mesh, &c.vertices, &c.triangles, &c.edges, &c.faces));
  const char* text = "";
  require(mesh, carreau_mesh_defects(mesh, limits.closed ? 1 : 0, limits.limit, &c.defects, &text));
  c.sentences = text;
  for (const FaceResult& face : arrays.faces)
    if (face.triangles == 0) c.not_meshed.push_back(face);
  c.measured = can_be_measured(arrays);
  if (c.measured) c.report = report_of(arrays, static_cast<std::size_t>(limits.worst), places);
  return c;
}

}  // namespace

MeshCheck check_of(carreau_mesh* mesh, const MeshArrays& arrays, const CheckLimits& limits, const Crossings* known) {
  MeshCheck c = look_at(mesh, arrays, limits);
  if (c.measured) ask_shapes(mesh, arrays.triangle_refs, known, c);
  return c;
}

MeshCheck check_of(carreau_mesh* mesh, const CheckLimits& limits) {
  MeshCheck c;
  std::vector<std::int32_t> refs;
  {
    MeshArrays arrays = arrays_of(mesh);
    c = look_at(mesh, arrays, limits);
    refs = std::move(arrays.triangle_refs);
  }
  if (c.measured) ask_shapes(mesh, refs, nullptr, c);
  return c;
}

bool has_elements(const carreau_cell_quality& q) { return q.triangles6 + q.quads4 + q.quads8 > 0; }

Json check_json(const MeshCheck& c, const std::string& name, int limit, bool allow_crossings) {
  Json defects = Json::array();
  for (std::size_t from = 0; from < c.sentences.size();) {
    const std::size_t to = std::min(c.sentences.find('\n', from), c.sentences.size());
    defects.push_back(c.sentences.substr(from, to - from));
    from = to + 1;
  }
  if (c.crossings.pairs > 0 && !allow_crossings) defects.push_back(crossings_count(c.crossings.pairs));
  Json result = {
      {"mesh", name},           {"vertices", c.vertices}, {"triangles", c.triangles},        {"faces", c.faces},
      {"curve_edges", c.edges}, {"defects", defects},     {"all_defects", c.defects < limit}};
  for (const FaceResult& face : c.not_meshed)
    result["not_meshed"].push_back(
        {{"reference", face.ref}, {"name", face.name}, {"status", status_word(face.status)}, {"why", face.why}});
  if (c.measured) {
    result["quality"] = quality_json(c.quality);
    if (has_elements(c.cells)) {
      result["elements"] = elements_json(c.cells);
      result["elements"]["order"] = c.order;
    }
    result["report"] = json_of(c.report);
    result["intersections"] = crossings_json(c.crossings);
  }
  return result;
}

}  // namespace command
