// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/base/sharp_edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "cad/batches.h"
#include "cad/fundamental_forms.h"
#include "model/bucket_sort.h"
#include "model/union_find.h"
#include "surface/remesh/base/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::remesh;

/// A side of a triangle, by its start.
struct FaceSide {
  MeshEdge edge;
  std::int32_t face, triangle;
  int side;
  friend auto operator<=>(const FaceSide&, const FaceSide&) = default;
};

std::vector<MeshEdge> edges_of_curves(const SurfaceMesh& mesh, bool internal_only) {
  std::vector<MeshEdge> edges;
  for (const CurveMesh& curve : mesh.curves) {
    const bool internal = std::ranges::any_of(curve.uses, [](const CurveMeshUse& u) { return u.internal; });
    if (internal_only && !internal) continue;
    for (std::size_t i = 1; i < curve.vertices.size(); ++i)
      edges.push_back(mesh_edge(curve.vertices[i - 1], curve.vertices[i]));
  }
  bucket_sort(edges, mesh.vertices.size(), [](const MeshEdge& e) { return e[0]; });
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<FaceSide> sides_on(const SurfaceMesh& mesh, const std::vector<MeshEdge>& edges) {
  std::vector<FaceSide> sides;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceMesh& face = mesh.faces[f];
    for (std::size_t t = 0; t < face.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        const MeshEdge edge = mesh_edge(face.vertex[face.triangles[t][i]], face.vertex[face.triangles[t][(i + 1) % 3]]);
        if (std::ranges::binary_search(edges, edge))
          sides.push_back({edge, static_cast<std::int32_t>(f), static_cast<std::int32_t>(t), i});
      }
  }
  bucket_sort(sides, mesh.vertices.size(), [](const FaceSide& s) { return s.edge[0]; });
  return sides;
}

/// Normals of both faces at the ends of an edge with two triangles.
class EdgeAngle {
 public:
  EdgeAngle(const SurfaceMesh& mesh, const VertexJets& jets, double angle)
      : mesh_(mesh), jets_(jets), cosine_(std::cos(angle * std::numbers::pi / 180)) {}

  [[nodiscard]] bool is_sharp(const FaceSide& p, const FaceSide& q) const {
    const auto [a, b] = ends(p);
    auto [c, d] = ends(q);
    const bool opposite = vertex(p.face, a) == vertex(q.face, d);
    if (opposite) std::swap(c, d);
    const double sign = opposite ? 1 : -1;
    bool known = false;
    for (const auto& [v, w] : {std::pair{a, c}, std::pair{b, d}}) {
      const auto n = unit_normal(jets_[p.face][v]), m = unit_normal(jets_[q.face][w]);
      if (!n || !m) continue;
      known = true;
      if (sign * dot(*n, *m) < cosine_) return true;
    }
    return !known && sign * dot(normal(p), normal(q)) < cosine_ * norm(normal(p)) * norm(normal(q));
  }

 private:
  [[nodiscard]] std::array<std::int32_t, 2> ends(const FaceSide& s) const {
    const auto& t = mesh_.faces[s.face].triangles[s.triangle];
    return {t[s.side], t[(s.side + 1) % 3]};
  }
  [[nodiscard]] std::int32_t vertex(std::int32_t face, std::int32_t local) const {
    return mesh_.faces[face].vertex[local];
  }
  [[nodiscard]] Vec3 normal(const FaceSide& s) const {
    const auto& t = mesh_.faces[s.face].triangles[s.triangle];
    const auto corner = [&](int i) -> const Vec3& { return mesh_.vertices[vertex(s.face, t[i])]; };
    return cross(corner(1) - corner(0), corner(2) - corner(0));
  }

  const SurfaceMesh& mesh_;
  const VertexJets& jets_;
  double cosine_;
};

/// Discs of triangles around each vertex that no sharp edge divides, and how many triangles sharp edges have.
class Surroundings {
 public:
  Surroundings(const SurfaceMesh& mesh, const Charts& charts) : discs_(mesh.vertices.size(), 0) {
    const auto& triangles = charts.triangles();
    UnionFind sets(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        const std::int32_t u = triangles[t].beyond[i];
        if (u < 0) continue;
        for (const int k : {i, (i + 1) % 3}) {
          const auto j = std::ranges::find(triangles[u].vertex, triangles[t].vertex[k]) - triangles[u].vertex.begin();
          sets.merge(3 * t + static_cast<std::size_t>(k), static_cast<std::size_t>(3 * u + j));
        }
      }
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (int i = 0; i < 3; ++i)
        if (const std::size_t corner = 3 * t + static_cast<std::size_t>(i); sets.find(corner) == corner)
          ++discs_[triangles[t].vertex[i]];
  }
  [[nodiscard]] int discs(std::int32_t v) const { return discs_[v]; }

 private:
  std::vector<int> discs_;
};

/// The sharp edges at each vertex, with their curves.
struct LineEnd {
  std::int32_t vertex, other, curve;
  friend auto operator<=>(const LineEnd&, const LineEnd&) = default;
};

std::vector<LineEnd> incidences(const SurfaceMesh& mesh, const std::vector<MeshEdge>& sharp) {
  std::vector<LineEnd> all;
  for (std::size_t c = 0; c < mesh.curves.size(); ++c)
    for (std::size_t i = 1; i < mesh.curves[c].vertices.size(); ++i) {
      const std::int32_t v = mesh.curves[c].vertices[i - 1], w = mesh.curves[c].vertices[i];
      if (!std::ranges::binary_search(sharp, mesh_edge(v, w))) continue;
      all.push_back({v, w, static_cast<std::int32_t>(c)});
      all.push_back({w, v, static_cast<std::int32_t>(c)});
    }
  std::ranges::sort(all);
  const auto same = [](const LineEnd& p, const LineEnd& q) { return p.vertex == q.vertex && p.other == q.other; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

std::span<const LineEnd> at_vertex(const std::vector<LineEnd>& all, std::int32_t v) {
  return {std::ranges::lower_bound(all, v, {}, &LineEnd::vertex), std::ranges::upper_bound(all, v, {}, &LineEnd::vertex)};
}

/// Directions in which curves leave their ends, by their supports.
class Tangents {
 public:
  Tangents(const SurfaceMesh& mesh, const Topology* topology, const std::vector<std::vector<CurveSupport>>& supports)
      : mesh_(mesh), topology_(topology), supports_(supports) {}

  /// Returns whether the two edges at a vertex belong to one line that goes straight on.
  [[nodiscard]] bool go_on(std::span<const LineEnd> two, double cosine) const {
    const std::int32_t v = two[0].vertex;
    if (two[0].curve == two[1].curve && is_inside(two[0].curve, v)) return true;
    if (topology_ == nullptr) return false;
    const auto p = leaving(two[0]), q = leaving(two[1]);
    return p && q && -dot(*p, *q) >= cosine * norm(*p) * norm(*q);
  }

 private:
  [[nodiscard]] bool is_inside(std::int32_t c, std::int32_t v) const {
    const auto& chain = mesh_.curves[c].vertices;
    return chain.front() != v && chain.back() != v;
  }
  [[nodiscard]] std::optional<Vec3> leaving(const LineEnd& edge) const {
    const auto& chain = mesh_.curves[edge.curve].vertices;
    const CurveUse& use = topology_->curves[edge.curve].uses.front();
    const std::vector<Vec3>& xyz = supports_[use.face][use.curve].xyz;
    if (chain.front() == edge.vertex && chain[1] == edge.other) return Vec3(xyz[1] - xyz[0]);
    if (chain.back() == edge.vertex) return Vec3(xyz[xyz.size() - 2] - xyz.back());
    return {};
  }

  const SurfaceMesh& mesh_;
  const Topology* topology_;
  const std::vector<std::vector<CurveSupport>>& supports_;
};

// Imposed points have references and end no curve.
std::vector<char> mark_imposed(const SurfaceMesh& mesh, const VertexJets& jets) {
  std::vector<char> marks(mesh.vertices.size(), 0);
  for (std::size_t v = 0; v < marks.size(); ++v) marks[v] = static_cast<char>(mesh.vertex_ref[v] != 0);
  for (const CurveMesh& curve : mesh.curves)
    if (!curve.vertices.empty()) marks[curve.vertices.front()] = marks[curve.vertices.back()] = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t k = 0; k < mesh.faces[f].vertex.size(); ++k)
      if (!unit_normal(jets[f][k])) marks[mesh.faces[f].vertex[k]] = 1;
  return marks;
}

}  // namespace

VertexJets evaluate_vertices(const SurfaceMesh& mesh, Cad& cad, Monitor& monitor) {
  VertexJets all(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceMesh& face = mesh.faces[f];
    all[f].resize(face.uv.size());
    if (face.triangles.empty()) continue;
    for_batches(cad, face.ref, want_first, face.uv, monitor,
                [&](std::size_t first, std::span<const Vec2>, std::span<const SurfaceJet> jets) {
                  std::ranges::copy(jets, all[f].begin() + static_cast<std::ptrdiff_t>(first));
                });
  }
  return all;
}

std::vector<MeshEdge> find_sharp_edges(const SurfaceMesh& mesh, const VertexJets& jets, double angle) {
  const std::vector<MeshEdge> edges = edges_of_curves(mesh, false), internal = edges_of_curves(mesh, true);
  const std::vector<FaceSide> sides = sides_on(mesh, edges);
  const EdgeAngle between(mesh, jets, angle);
  std::vector<MeshEdge> sharp;
  for (std::size_t k = 0, n = 0; k < sides.size(); k += n) {
    for (n = 1; k + n < sides.size() && sides[k + n].edge == sides[k].edge;) ++n;
    if (n != 2 || std::ranges::binary_search(internal, sides[k].edge) || between.is_sharp(sides[k], sides[k + 1]))
      sharp.push_back(sides[k].edge);
  }
  return sharp;
}

std::vector<std::int32_t> find_corners(const SurfaceMesh& mesh, const VertexJets& jets, const Charts& charts,
                                       const std::vector<MeshEdge>& sharp, const Topology* topology,
                                       const std::vector<std::vector<CurveSupport>>& supports, double angle) {
  const Surroundings around(mesh, charts);
  const std::vector<LineEnd> edges = incidences(mesh, sharp);
  const Tangents tangents(mesh, topology, supports);
  const double cosine = std::cos((angle + support_angle) * std::numbers::pi / 180);
  std::vector<char> corner = mark_imposed(mesh, jets);
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(corner.size()); ++v) {
    const auto here = at_vertex(edges, v);
    if (here.empty() ? around.discs(v) > 1 : here.size() != 2 || !tangents.go_on(here, cosine)) corner[v] = 1;
  }
  for (const CurveMesh& curve : mesh.curves)  // the ends of free curves keep their places
    for (std::size_t k = 0; curve.loose && k < curve.vertices.size(); ++k)
      if (around.discs(curve.vertices[k]) > 0) corner[curve.vertices[k]] = 1;
  // A line may touch a second line at one of its vertices.
  std::map<MeshEdge, int> count;
  for (const MeshEdge& e : sharp) count[e] = 0;
  for (const auto& t : charts.triangles())
    for (int i = 0; i < 3; ++i)
      if (t.beyond[i] < 0)
        if (const auto it = count.find(mesh_edge(t.vertex[i], t.vertex[(i + 1) % 3])); it != count.end()) ++it->second;
  for (const LineEnd& e : edges)
    if (count[mesh_edge(e.vertex, e.other)] != around.discs(e.vertex)) corner[e.vertex] = 1;
  std::vector<std::int32_t> corners;
  for (std::size_t v = 0; v < corner.size(); ++v)
    if (corner[v] != 0) corners.push_back(static_cast<std::int32_t>(v));
  return corners;
}

std::vector<SharpLine> find_lines(const SurfaceMesh& mesh, const std::vector<MeshEdge>& sharp,
                                  const std::vector<std::int32_t>& corners) {
  const std::vector<LineEnd> edges = incidences(mesh, sharp);
  std::vector<char> used(edges.size(), 0);
  const auto use = [&](std::int32_t v, std::int32_t w) {
    const auto at = std::ranges::lower_bound(edges, LineEnd{v, w, -1}) - edges.begin();
    used[at] = 1;
  };
  std::vector<SharpLine> lines;
  const auto follow = [&](std::size_t first) {
    SharpLine line{{edges[first].vertex}, {}};
    const LineEnd* next = &edges[first];
    while (next != nullptr) {
      use(next->vertex, next->other), use(next->other, next->vertex);
      line.vertices.push_back(next->other);
      line.curve.push_back(next->curve);
      const std::int32_t v = next->other;
      next = nullptr;
      if (std::ranges::binary_search(corners, v)) break;
      for (const LineEnd& e : at_vertex(edges, v))
        if (used[&e - edges.data()] == 0) next = &e;
    }
    lines.push_back(std::move(line));
  };
  for (std::size_t k = 0; k < edges.size(); ++k)
    if (used[k] == 0 && std::ranges::binary_search(corners, edges[k].vertex)) follow(k);
  // Loops start where a curve does, if they may.
  for (const bool any : {false, true})
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (used[k] == 0 && (any || mesh.vertex_ref[edges[k].vertex] != 0)) follow(k);
  return lines;
}

}  // namespace carreau
