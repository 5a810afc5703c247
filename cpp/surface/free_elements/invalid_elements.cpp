// SPDX-License-Identifier: BSD-3-Clause
#include "surface/free_elements/invalid_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "mesh/elements/jacobian.h"
#include "support/error.h"
#include "support/infinity.h"
#include "surface/independent/base/charts.h"

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
  Finder(const SizedMesh& made, Element element) : made_(made), share_(has_quads_only(element) ? 1 : 0.5) {
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
  // Sizes are asked of the mesh that is cut, if one is.
  void add(const FaceMesh& face, const Cell& cell) {
    ++found_.count;
    const int n = corner_count(cell.kind);
    const auto at = [&](int k) { return face.vertex[cell.nodes[k % n]]; };
    double longest = 0, least = infinity;
    for (int k = 0; k < n; ++k) {
      longest = std::max(longest, norm(made_.mesh.vertices[at(k + 1)] - made_.mesh.vertices[at(k)]));
      if (const double size = made_.vertex_size[at(k)]; size > 0) least = std::min(least, size);
    }
    std::vector<std::int32_t> faces;  // it may lie over several
    for (int k = 0; k < n; ++k) faces.push_back(face.uv_face[cell.nodes[k]]);
    std::ranges::sort(faces);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    for (int k = 0; k < n; ++k) {
      const EdgeSizes::Source side{made_.mesh.vertices[at(k)], made_.mesh.vertices[at(k + 1)], share_ * std::min(longest, least)};
      for (const std::int32_t f : faces) found_.finer[f].push_back(side);
      add_coarse(mesh_edge(at(k), at(k + 1)));
    }
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
  double share_;
  std::map<MeshEdge, std::pair<std::size_t, std::size_t>> on_curve_;  // the curve, and the rank of the second end
  InvalidInSpace found_;
};

}  // namespace

InvalidInSpace find_invalid(const SizedMesh& made, Element element) { return Finder(made, element).run(); }

void tell_invalid(SurfaceMesh& mesh) {
  for (FaceMesh& face : mesh.faces) {
    std::size_t count = 0;
    Vec2 uv{0, 0};
    for (const Cell& cell : local_cells(face)) {
      if (is_valid(mesh, face, cell)) continue;
      if (++count == 1) uv = face.uv[cell.nodes[0]];
    }
    if (count == 0) continue;
    const std::string what = Where{.face = face.ref, .uv = uv}.prefix() + std::to_string(count) +
                             (count == 1 ? " element has" : " elements have") + " a Jacobian that is not positive everywhere";
    face.status = FaceStatus::mended;
    face.why += (face.why.empty() ? "" : "; ") + what;
  }
}

void fail_wrong_joints(SizedMesh& made) {
  const std::vector<std::int32_t> wrong = find_wrong_joints(made.mesh);
  for (std::size_t f = 0; f < made.mesh.faces.size(); ++f) {
    FaceMesh& face = made.mesh.faces[f];
    const auto is_wrong = [&](std::int32_t v) { return std::ranges::binary_search(wrong, face.vertex[v]); };
    const auto found = std::ranges::find_if(face.triangles, [&](const auto& t) { return std::ranges::count_if(t, is_wrong) > 1; });
    if (found == face.triangles.end()) continue;
    const Vec3 at = made.mesh.vertices[face.vertex[*std::ranges::find_if(*found, is_wrong)]];
    const std::string why = Where{.face = face.ref}.prefix() + "elements would run along one edge more than once, near x = " +
                            std::to_string(at[0]) + ", y = " + std::to_string(at[1]) + ", z = " + std::to_string(at[2]);
    FaceMesh failed;
    failed.ref = face.ref, failed.name = face.name, failed.rgb = face.rgb, failed.part_of = face.part_of;
    failed.status = FaceStatus::failed, failed.why = why;
    face = std::move(failed);
    if (f < made.feet.size()) made.feet[f].clear();
    if (f < made.mid_feet.size()) made.mid_feet[f].clear();
  }
}

}  // namespace carreau
