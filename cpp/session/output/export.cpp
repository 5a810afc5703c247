// SPDX-License-Identifier: BSD-3-Clause
#include "session/output/export.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <type_traits>

#include "mesh/elements/cell_quality.h"
#include "mesh/periodic_masters.h"
#include "mesh/quality.h"
#include "support/error.h"

namespace carreau {

namespace {

struct CurveEdge {
  std::array<std::int32_t, 2> key;
  int ref;
  friend auto operator<=>(const CurveEdge&, const CurveEdge&) = default;
};

std::array<std::int32_t, 2> ordered(std::int32_t a, std::int32_t b) {
  return a < b ? std::array{a, b} : std::array{b, a};
}

std::vector<CurveEdge> edges_of_curves(const SurfaceMesh& mesh) {
  std::vector<CurveEdge> edges;
  for (const CurveMesh& curve : mesh.curves)
    for (std::size_t i = 1; i < curve.vertices.size(); ++i)
      edges.push_back({ordered(curve.vertices[i - 1], curve.vertices[i]), curve.shown_ref()});
  std::sort(edges.begin(), edges.end());
  return edges;
}

// The origin of the entities of a flat mesh: vertex and triangle of the surface mesh (-1: not in space).
struct FlatSources {
  std::vector<std::int32_t> vertex;
  std::vector<std::int64_t> triangle;
  bool whole = false;  // all of the surface mesh, in its order
};

// Appends one face, in space or in its parameter plane, with its own vertices only.
class FaceAppender {
 public:
  FaceAppender(const SurfaceMesh& mesh, bool plane, bool with_edges)
      : mesh_(mesh), wholes_(whole_faces(mesh)), plane_(plane), of_cells_(mesh.cells_are_not_triangles()) {
    if (with_edges) curve_edges_ = edges_of_curves(mesh);
    flat_.dimension = plane ? 2 : 3;
  }

  /// `first`: the first triangle of the face among the triangles of the mesh.
  void append(const FaceMesh& face, std::size_t first) {
    // Parts of a face share their vertices of space.
    const bool goes_on = !flat_.faces.empty() && flat_.faces.back().ref == face.part_of && face.part_of != 0;
    if (plane_ || !goes_on) rank_.assign(plane_ ? face.uv.size() : mesh_.vertices.size(), -1);
    edges_.clear();
    mid_rank_.assign(face.mid_uv.size(), -1);
    if (!goes_on) flat_.faces.push_back(whole_of(face.shown_ref()));
    number_nodes(face);
    if (of_cells_) append_cells(face);
    for (std::size_t t = 0; t < face.triangles.size(); ++t, ++first) {
      if (plane_ && face.is_spread(t)) continue;  // no triangle of (u, v)
      append_triangle(face, face.triangles[t]);
      triangle_source_.push_back(static_cast<std::int64_t>(first));
    }
    if (plane_ && !of_cells_)
      for (const auto& t : face.flattened) append_triangle(face, t);
    triangle_source_.resize(flat_.triangles.size(), -1);
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    for (const CurveEdge& edge : edges_) {
      flat_.edges.push_back({edge.key[0], edge.key[1]});
      flat_.edge_refs.push_back(edge.ref);
      if (const auto mid = mids_.find(edge.key); mid != mids_.end()) flat_.edge_mids.push_back(mid->second);
    }
  }

  FlatMesh take() { return std::move(flat_); }
  [[nodiscard]] FlatSources sources() const { return {source_, triangle_source_, false}; }

 private:
  [[nodiscard]] FlatFace whole_of(int ref) const {
    const auto whole =
        std::find_if(wholes_.begin(), wholes_.end(), [&](const WholeFace& w) { return w.face.ref == ref; });
    return whole->face;
  }

  // Numbers the nodes of a face in the order of the mesh, so that all exports of one face number them alike.
  void number_nodes(const FaceMesh& face) {
    std::vector<std::array<std::int32_t, 2>> corners, mids;  // number in the mesh, number in the face
    const auto add = [&](const std::array<std::int32_t, 3>& t) {
      for (const std::int32_t local : t) corners.push_back({face.vertex[local], local});
    };
    for (std::size_t t = 0; t < face.triangles.size(); ++t)
      if (!plane_ || !face.is_spread(t)) add(face.triangles[t]);
    if (plane_ && !of_cells_)
      for (const auto& t : face.flattened) add(t);
    std::sort(corners.begin(), corners.end());
    for (const auto& [global, local] : corners) (void)vertex(face, local);
    if (!of_cells_) return;
    const auto first_mid = static_cast<std::int32_t>(face.uv.size());
    std::size_t t = 0;
    for (const Cell& cell : local_cells(face)) {
      for (int i = corner_count(cell.kind); i < node_count(cell.kind) && (!plane_ || !face.is_spread(t)); ++i)
        mids.push_back({face.mid_vertex[cell.nodes[i] - first_mid], cell.nodes[i] - first_mid});
      t += corner_count(cell.kind) == 4 ? 2 : 1;
    }
    std::sort(mids.begin(), mids.end());
    for (const auto& [global, local] : mids) (void)mid(face, local);
  }

  std::int32_t vertex(const FaceMesh& face, std::int32_t local) {
    const std::int32_t global = face.vertex[local];
    std::int32_t& rank = rank_[plane_ ? local : global];
    if (rank < 0) {
      rank = static_cast<std::int32_t>(flat_.vertices.size());
      flat_.vertices.push_back(plane_ ? Vec3{face.uv[local].x(), face.uv[local].y(), 0} : mesh_.vertices[global]);
      flat_.vertex_refs.push_back(mesh_.vertex_ref[global]);
      source_.push_back(global);
    }
    return rank;
  }

  std::int32_t mid(const FaceMesh& face, std::int32_t local) {
    std::int32_t& rank = mid_rank_[local];
    if (rank < 0) {
      rank = static_cast<std::int32_t>(flat_.vertices.size());
      const Vec2& p = face.mid_uv[local];
      flat_.vertices.push_back(plane_ ? Vec3{p.x(), p.y(), 0} : mesh_.mid_vertices[face.mid_vertex[local]]);
      flat_.vertex_refs.push_back(0);
      source_.push_back(-1);
    }
    return rank;
  }

  void append_cells(const FaceMesh& face) {
    std::size_t t = 0;
    for (const Cell& cell : local_cells(face)) {
      if (!plane_ || !face.is_spread(t)) append_cell(face, cell);
      t += corner_count(cell.kind) == 4 ? 2 : 1;
    }
  }

  void append_cell(const FaceMesh& face, const Cell& cell) {
    Cell own = cell;
    const int n = corner_count(cell.kind), all = node_count(cell.kind);
    for (int i = 0; i < n; ++i) own.nodes[i] = vertex(face, cell.nodes[i]);
    const auto corners = static_cast<std::int32_t>(face.uv.size());
    for (int i = n; i < all; ++i) {
      own.nodes[i] = mid(face, cell.nodes[i] - corners);
      mids_[ordered(own.nodes[i - n], own.nodes[(i - n + 1) % n])] = own.nodes[i];
    }
    flat_.cells.push_back(own);
  }

  void append_triangle(const FaceMesh& face, const std::array<std::int32_t, 3>& t) {
    std::array<std::int32_t, 3> corners{};
    for (int i = 0; i < 3; ++i) corners[i] = vertex(face, t[i]);
    flat_.triangles.push_back(corners);
    flat_.triangle_refs.push_back(face.shown_ref());
    for (int i = 0; i < 3 && !curve_edges_.empty(); ++i) {
      const auto key = ordered(face.vertex[t[i]], face.vertex[t[(i + 1) % 3]]);
      auto it = std::lower_bound(curve_edges_.begin(), curve_edges_.end(), CurveEdge{key, INT32_MIN});
      for (; it != curve_edges_.end() && it->key == key; ++it)
        edges_.push_back({ordered(corners[i], corners[(i + 1) % 3]), it->ref});
    }
  }

  const SurfaceMesh& mesh_;
  std::vector<WholeFace> wholes_;
  bool plane_, of_cells_;
  FlatMesh flat_;
  std::map<std::array<std::int32_t, 2>, std::int32_t> mids_;  // by edge of the flat mesh
  std::vector<CurveEdge> curve_edges_, edges_;
  std::vector<std::int32_t> rank_, mid_rank_, source_;
  std::vector<std::int64_t> triangle_source_;
};

// The face of a reference and its parts, which follow it.
std::vector<std::size_t> faces_of_reference(const SurfaceMesh& mesh, int ref) {
  std::vector<std::size_t> found;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.faces[f].shown_ref() == ref && mesh.faces[f].status != FaceStatus::wire) found.push_back(f);
  if (found.empty())
    throw InvalidArgument("export: no face has the reference " + std::to_string(ref) + " (parameter refs)");
  return found;
}

// Appends the points of a curve, between its ends.
template <typename Point>
void append_line(const FaceCurve& curve, const std::vector<Point>& points, FlatMesh& flat) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if constexpr (std::is_same_v<Point, Vec3>)
      flat.vertices.push_back(points[i]);
    else
      flat.vertices.push_back({points[i].x(), points[i].y(), 0});
    flat.vertex_refs.push_back(i == 0 ? curve.end1 : i + 1 == points.size() ? curve.end2 : 0);
    const auto last = static_cast<std::int32_t>(flat.vertices.size()) - 1;
    if (i > 0) flat.edges.push_back({last - 1, last}), flat.edge_refs.push_back(curve.ref);
  }
}

FlatMesh supports_as_mesh(const ExportSource& source) {
  FlatMesh flat;
  std::set<int> done;
  for (std::size_t f = 0; f < source.supports.of_face.size(); ++f)
    for (std::size_t c = 0; c < source.supports.of_face[f].size(); ++c) {
      // The first of several curves that are one in space represents all, as everywhere.
      const FaceCurve& curve = source.model.faces[f].curves[c];
      if (done.insert(curve.ref).second) append_line(curve, source.supports.of_face[f][c].xyz, flat);
    }
  return flat;
}

// Appends the known boundary of a face that has failed.
void append_boundary(const ExportSource& source, std::size_t f, FlatMesh& flat) {
  for (std::size_t c = 0; c < source.supports.of_face[f].size(); ++c) append_line(source.model.faces[f].curves[c], source.supports.of_face[f][c].uv, flat);
}

// The curves of a face's parts without triangles; curves of other parts are not shown. Empty: all have.
std::optional<FlatMesh> boundary_of_failed(const ExportSource& source, int ref) {
  FlatMesh flat;
  flat.dimension = 2;
  bool any = false, known = false;
  for (const std::size_t f : faces_of_reference(source.mesh, ref)) {
    if (!source.mesh.faces[f].triangles.empty()) continue;
    any = true;
    if (!source.model.faces[f].left_out.empty()) continue;
    known = true;
    append_boundary(source, f, flat);
  }
  if (!any) return std::nullopt;
  if (!known)
    throw InvalidArgument(Where{.face = ref}, "the face was left out of the mesh: its domain is unknown");
  return flat;
}

// Values at nodes on edges are the means of both ends.
void fill_mids(const FlatMesh& flat, std::vector<double>& values) {
  for (const Cell& cell : flat.cells) {
    const int n = corner_count(cell.kind);
    for (int i = 0; i < n && is_quadratic(cell.kind); ++i)
      values[cell.nodes[n + i]] = 0.5 * (values[cell.nodes[i]] + values[cell.nodes[(i + 1) % n]]);
  }
}

// Q1 and Q2 are of triangles: of other elements there are these.
void add_shapes(FlatMesh& flat) {
  MeshField shape{.name = "shape", .on_vertices = false, .components = 1, .values = {}, .edge_values = {}},
      scaled = shape, least = shape;
  scaled.name = "scaled_jacobian", least.name = "least_jacobian";
  for_cells(flat, [&](std::size_t, const Cell& cell, std::span<const Vec3> nodes, std::size_t) {
    const CellQuality q = cell_quality(cell.kind, nodes);
    for (int k = corner_count(cell.kind) - 2; k > 0; --k) {
      shape.values.push_back(q.shape), scaled.values.push_back(q.scaled_jacobian);
      least.values.push_back(q.least_jacobian);
    }
  });
  for (MeshField* field : {&shape, &scaled, &least}) flat.fields.push_back(std::move(*field));
}

void add_fields(FlatMesh& flat, const std::vector<double>& vertex_size, const FlatSources& sources) {
  MeshField size{.name = "size", .on_vertices = true, .components = 1, .values = {}, .edge_values = {}};
  size.values.reserve(sources.vertex.size());
  for (const std::int32_t v : sources.vertex) size.values.push_back(v < 0 ? 0 : vertex_size[v]);
  fill_mids(flat, size.values);
  MeshField q1{.name = "Q1", .on_vertices = false, .components = 1, .values = {}, .edge_values = {}}, q2 = q1;
  q2.name = "Q2";
  q1.values.reserve(flat.triangles.size());
  q2.values.reserve(flat.triangles.size());
  for (const auto& t : flat.triangles) {
    const Vec3 a = flat.vertices[t[0]], b = flat.vertices[t[1]], c = flat.vertices[t[2]];
    q1.values.push_back(quality_q1(a, b, c));
    q2.values.push_back(quality_q2(a, b, c));
  }
  for (MeshField* const field : {&size, &q1, &q2}) flat.fields.push_back(std::move(*field));
  if (!flat.cells.empty()) add_shapes(flat);
  add_periodic_masters(flat);
}

// A side of a triangle of the flat mesh: edge of the surface mesh, vertices of the flat one.
struct FlatEdge {
  std::int32_t edge;
  std::array<std::int32_t, 2> vertices;
  friend auto operator<=>(const FlatEdge&, const FlatEdge&) = default;
};

// Replaces the edges by the edges of all triangles; an edge that a seam gives two places in (u, v) comes twice there.
std::vector<FlatEdge> add_all_edges(FlatMesh& flat, const SurfaceMesh& mesh, const MeshEvaluation& delivered,
                                    const FlatSources& sources) {
  std::vector<FlatEdge> all;
  for (std::size_t t = 0; t < flat.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3 && sources.triangle[t] >= 0; ++i)
      all.push_back({delivered.edges.of_triangle[sources.triangle[t]][i],
                     ordered(flat.triangles[t][i], flat.triangles[t][(i + 1) % 3])});
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  flat.edges.clear();
  flat.edge_refs.clear();
  flat.edge_mids.clear();
  for (const CurveMesh& curve : mesh.curves) {
    if (!curve.loose || !sources.whole) continue;
    for (std::size_t i = 1; i < curve.vertices.size(); ++i) {
      flat.edges.push_back({curve.vertices[i - 1], curve.vertices[i]});
      flat.edge_refs.push_back(curve.shown_ref());
    }
  }
  for (const FlatEdge& each : all) {
    const std::int32_t segment = delivered.edges.segment[each.edge];
    flat.edges.push_back(each.vertices);
    flat.edge_refs.push_back(segment < 0 ? 0 : mesh.curves[delivered.edges.segments[segment].curve].shown_ref());
  }
  return all;
}

void add_evaluation(FlatMesh& flat, const ExportSource& source, const FlatSources& sources, bool with_edges) {
  const MeshEvaluation& delivered = *source.delivered;
  std::vector<FlatEdge> edges;
  if (with_edges) edges = add_all_edges(flat, source.mesh, delivered, sources);
  for (const EvaluatedMeasure& row : delivered_measures()) {
    const bool known = std::any_of(flat.fields.begin(), flat.fields.end(),
                                   [&](const MeshField& field) { return field.name == row.name; });
    const bool unbounded = row.kind >= EvaluationKind::deviation_bound && delivered[row.kind].spread.count == 0;
    if (known || unbounded || (row.entity == EvaluationEntity::edge && !with_edges)) continue;
    const std::vector<double>& values = delivered[row.kind].values;
    MeshField field{.name = row.name,
                    .on_vertices = row.entity == EvaluationEntity::vertex,
                    .components = 1,
                    .values = {},
                    .edge_values = {}};
    if (row.entity == EvaluationEntity::vertex)
      for (const std::int32_t v : sources.vertex)
        field.values.push_back(v < 0 ? std::numeric_limits<double>::quiet_NaN() : values[v]);
    if (row.entity == EvaluationEntity::triangle)
      for (const std::int64_t t : sources.triangle)
        field.values.push_back(t < 0 ? std::numeric_limits<double>::quiet_NaN() : values[t]);
    if (row.entity == EvaluationEntity::edge) {
      field.edge_values.assign(flat.edges.size() - edges.size(), std::numeric_limits<double>::quiet_NaN());  // loose
      for (const FlatEdge& each : edges) field.edge_values.push_back(values[each.edge]);
    }
    flat.fields.push_back(std::move(field));
  }
}

FlatSources all_of(const SurfaceMesh& mesh) {
  FlatSources sources{std::vector<std::int32_t>(mesh.vertices.size()), std::vector<std::int64_t>(mesh.triangle_count()),
                      true};
  std::iota(sources.vertex.begin(), sources.vertex.end(), 0);
  sources.vertex.resize(mesh.vertices.size() + mesh.mid_vertices.size(), -1);
  std::iota(sources.triangle.begin(), sources.triangle.end(), 0);
  return sources;
}

}  // namespace

FlatMesh export_mesh(const ExportSource& source, const std::string& option, int face, bool with_edges) {
  if (option == "smo3d") return supports_as_mesh(source);
  const bool plane = option == "allsurf2d" || option == "onesurf2d", whole = option.empty() || option == "allsurf3d";
  if (!plane && !whole && option != "onesurf3d") throw InvalidArgument("export: unknown option \"" + option + "\"");
  if (option == "onesurf2d")
    if (std::optional<FlatMesh> failed = boundary_of_failed(source, face)) return std::move(*failed);
  FlatMesh flat;
  FlatSources sources;
  if (whole) {
    flat = flatten(source.mesh, with_edges);
    if (source.with_fields || source.delivered != nullptr) sources = all_of(source.mesh);  // a third of the mesh's size
  } else {
    FaceAppender appender(source.mesh, plane, with_edges);
    if (option != "allsurf2d") (void)faces_of_reference(source.mesh, face);
    std::size_t first = 0;
    for (std::size_t f = 0; f < source.mesh.faces.size(); ++f) {
      if (option == "allsurf2d" || source.mesh.faces[f].shown_ref() == face)
        appender.append(source.mesh.faces[f], first);
      first += source.mesh.faces[f].triangles.size();
    }
    sources = appender.sources();
    flat = appender.take();
  }
  if (!plane && source.with_fields) add_fields(flat, source.vertex_size, sources);
  if (source.delivered != nullptr) add_evaluation(flat, source, sources, with_edges);
  return flat;
}

}  // namespace carreau
