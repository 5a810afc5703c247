// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/cross_patch/invalid_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "mesh/elements/jacobian.h"
#include "support/error.h"
#include "support/infinity.h"
#include "support/ranks/all_that_hold.h"
#include "surface/assembly/whole_mesh.h"
#include "surface/elements/base/invalid_report.h"
#include "surface/remesh/base/charts.h"

namespace carreau {

namespace {

bool is_valid(const SurfaceMesh& mesh, const FaceMesh& face, const Cell& cell) {
  if (cell.kind == CellKind::triangle3) return true;
  std::array<Vec3, 8> nodes;
  const auto n = static_cast<std::size_t>(node_count(cell.kind));
  const auto corners = static_cast<std::int32_t>(face.uv.size());
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t node = cell.nodes[i];
    nodes[i] = node < corners ? mesh.vertices[face.vertex[node]] : mesh.mid_vertices[face.mid_vertex[node - corners]];
  }
  return jacobian(cell.kind, {nodes.data(), n}).least() > 0;
}

class Finder {
 public:
  Finder(const SizedMesh& made, Element element) : made_(made), element_(element) {
    for (std::size_t c = 0; c < made.mesh.curves.size(); ++c)
      for (std::size_t k = 1; k < made.mesh.curves[c].vertices.size(); ++k) {
        const std::vector<std::int32_t>& chain = made.mesh.curves[c].vertices;
        on_curve_.try_emplace(mesh_edge(chain[k - 1], chain[k]), c, k);
      }
    found_.finer.resize(made.mesh.faces.size());
  }

  InvalidInSpace run() {
    for (const FaceMesh& face : made_.mesh.faces)
      for (const Cell& cell : local_cells(face))
        if (!is_valid(made_.mesh, face, cell)) add(face, cell);
    std::ranges::sort(found_.coarse);
    found_.coarse.erase(std::unique(found_.coarse.begin(), found_.coarse.end()), found_.coarse.end());
    return std::move(found_);
  }

 private:
  // If the mesh of triangles is cut into quadrilaterals, sizes apply to the triangles.
  void add(const FaceMesh& face, const Cell& cell) {
    ++found_.count;
    const int n = corner_count(cell.kind);
    const auto at = [&](int k) { return face.vertex[cell.nodes[k % n]]; };
    std::vector<std::int32_t> faces;  // it may lie over several
    for (int k = 0; k < n; ++k) faces.push_back(face.uv_face[cell.nodes[k]]);
    std::ranges::sort(faces);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    const auto sides = finer_sides(made_.mesh, face, cell, made_.vertex_size, element_);
    for (const std::int32_t f : faces) found_.finer[f].insert(found_.finer[f].end(), sides.begin(), sides.end());
    for (int k = 0; k < n; ++k) add_coarse(mesh_edge(at(k), at(k + 1)));
  }
  void add_coarse(const MeshEdge& edge) {
    const auto found = on_curve_.find(edge);
    if (found == on_curve_.end()) return;
    const auto [c, k] = found->second;
    const CurveParameters& on = made_.curve_parameters[c];
    if (on.t.empty() || !std::isfinite(on.t[k - 1]) || !std::isfinite(on.t[k])) return;
    found_.coarse.push_back({on.face, on.ic, std::min(on.t[k - 1], on.t[k]), std::max(on.t[k - 1], on.t[k])});
  }

  const SizedMesh& made_;
  Element element_;
  std::map<MeshEdge, std::pair<std::size_t, std::size_t>> on_curve_;  // the curve, and the rank of the second end
  InvalidInSpace found_;
};

}  // namespace

InvalidInSpace find_invalid(const SizedMesh& made, Element element) { return Finder(made, element).run(); }

void tell_invalid(const SurfaceMesh& mesh, FaceMesh& face) {
  std::size_t count = 0;
  Vec2 uv{0, 0};
  for (const Cell& cell : local_cells(face)) {
    if (is_valid(mesh, face, cell)) continue;
    if (++count == 1) uv = face.uv[cell.nodes[0]];
  }
  if (count > 0) mark_invalid(face, uv, count);
}

void tell_invalid(SurfaceMesh& mesh) {
  for (FaceMesh& face : mesh.faces) tell_invalid(mesh, face);
}

void fail_wrong_joints(SizedMesh& made) {
  const std::vector<std::int32_t> wrong = find_wrong_joints(made.mesh);
  for (std::size_t f = 0; f < made.mesh.faces.size(); ++f) {
    FaceMesh& face = made.mesh.faces[f];
    const auto is_wrong = [&](std::int32_t v) { return std::ranges::binary_search(wrong, face.vertex[v]); };
    const auto found = std::ranges::find_if(face.triangles, [&](const auto& t) { return std::ranges::count_if(t, is_wrong) > 1; });
    if (found == face.triangles.end()) continue;
    const Vec3 at = made.mesh.vertices[face.vertex[*std::ranges::find_if(*found, is_wrong)]];
    const std::string why = Where{.face = face.shown_ref()}.prefix() + "elements would run along one edge more than once, near x = " +
                            std::to_string(at[0]) + ", y = " + std::to_string(at[1]) + ", z = " + std::to_string(at[2]);
    FaceMesh failed;
    failed.ref = face.ref, failed.name = face.name, failed.rgb = face.rgb, failed.part_of = face.part_of;
    failed.status = FaceStatus::failed, failed.why = why;
    face = std::move(failed);
    if (f < made.feet.size()) made.feet[f].clear();
    if (f < made.mid_feet.size()) made.mid_feet[f].clear();
  }
}

namespace {

/// An edge, or a triangle, at a vertex of a curve, and its face.
template <std::size_t N>
struct AtCurves {
  std::array<std::int32_t, N> vertices;
  std::int32_t face;
  friend auto operator<=>(const AtCurves&, const AtCurves&) = default;
};

template <std::size_t N>
std::array<std::int32_t, N> ascending(std::array<std::int32_t, N> vertices) {
  std::ranges::sort(vertices);
  return vertices;
}

/// Edges of curves, once for each triangle that they should have.
std::vector<AtCurves<2>> wanted_at_curves(const SurfaceMesh& mesh) {
  std::vector<AtCurves<2>> wanted;
  for (const CurveMesh& curve : mesh.curves)
    for (const CurveMeshUse& use : curve.uses) {
      const FaceStatus status = mesh.faces[use.face].status;
      if (status != FaceStatus::meshed && status != FaceStatus::mended) continue;
      for (std::size_t k = 1; k < curve.vertices.size(); ++k)
        for (int n = use.internal ? 2 : 1; n > 0; --n)
          wanted.push_back({ascending<2>({curve.vertices[k - 1], curve.vertices[k]}), static_cast<std::int32_t>(use.face)});
    }
  std::ranges::sort(wanted);
  return wanted;
}

bool joins_wrongly_at_curves(const SurfaceMesh& mesh, int threads, Monitor& monitor) {
  std::vector<char> on_curve(mesh.vertices.size(), 0);
  for (const CurveMesh& curve : mesh.curves)
    for (const std::int32_t v : curve.vertices) on_curve[v] = 1;
  std::vector<AtCurves<2>> edges;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceMesh& face = mesh.faces[f];
    const auto is_on = [&](std::int32_t v) { return on_curve[face.vertex[v]] != 0; };
    const auto touches = [&](std::size_t t) {
      return is_on(face.triangles[t][0]) || is_on(face.triangles[t][1]) || is_on(face.triangles[t][2]);
    };
    for (const std::int32_t t : all_that_hold(face.triangles.size(), {nullptr, threads}, "", monitor, touches)) {
      std::array<std::int32_t, 3> v{};
      for (std::size_t i = 0; i < 3; ++i) v[i] = face.vertex[face.triangles[t][i]];
      triangles.push_back(ascending(v));
      for (std::size_t i = 0; i < 3; ++i)
        if (on_curve[v[i]] != 0 || on_curve[v[(i + 1) % 3]] != 0)
          edges.push_back({ascending<2>({v[i], v[(i + 1) % 3]}), static_cast<std::int32_t>(f)});
    }
  }
  std::ranges::sort(triangles);
  if (std::ranges::adjacent_find(triangles) != triangles.end()) return true;
  std::ranges::sort(edges);
  const std::vector<AtCurves<2>> wanted = wanted_at_curves(mesh);
  std::size_t w = 0;
  for (std::size_t i = 0; i < edges.size();) {
    const std::array<std::int32_t, 2> key = edges[i].vertices;
    if (w < wanted.size() && wanted[w].vertices < key) return true;  // a triangle is missing
    const bool of_curve = w < wanted.size() && wanted[w].vertices == key;
    std::size_t all = 0;
    while (i < edges.size() && edges[i].vertices == key) {
      const AtCurves<2> edge = edges[i];
      std::size_t have = 0, want = 0;
      while (i < edges.size() && edges[i] == edge) ++i, ++have;
      while (w < wanted.size() && wanted[w] == edge) ++w, ++want;
      // Triangles of meshes free of patches have neighbours in other faces.
      if (want > 0 ? have != want : have != 2 && !mesh.independent) return true;
      all += have;
    }
    if (!of_curve && mesh.independent && all != 2) return true;
  }
  return w < wanted.size();
}

// Drops vertices and nodes that only faces without a mesh had. Vertices of curves stay.
void drop_lost(SizedMesh& made) {
  for (CurveMesh& curve : made.mesh.curves)
    if (std::ranges::all_of(curve.uses, [&](const CurveMeshUse& use) { return made.mesh.faces[use.face].status == FaceStatus::failed; })) curve.mid.clear();
  (void)drop_unused(made);
}

// False: all faces that are meshed have triangles.
bool fail_empty_faces(SurfaceMesh& mesh) {
  bool any = false;
  for (FaceMesh& face : mesh.faces) {
    if (!face.triangles.empty() || (face.status != FaceStatus::meshed && face.status != FaceStatus::mended)) continue;
    face.status = FaceStatus::failed, any = true;
    face.why += (face.why.empty() ? Where{.face = face.shown_ref()}.prefix() : std::string("; ")) + "no triangle is left of the face";
  }
  return any;
}

}  // namespace

bool fail_unsound_faces(SizedMesh& made, int threads, Monitor& monitor) {
  const bool empty = fail_empty_faces(made.mesh), wrong = joins_wrongly_at_curves(made.mesh, threads, monitor);
  if (wrong) fail_wrong_joints(made);
  if (empty || wrong) drop_lost(made);
  return empty || wrong;
}

}  // namespace carreau
