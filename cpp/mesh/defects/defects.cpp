// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>

#include "mesh/defects/cell_defects.h"
#include "mesh/quality.h"
#include "mesh/surface_mesh.h"
#include "model/bucket_sort.h"
#include "predicates/predicates.h"

namespace carreau {

namespace {

class DefectFinder {
 public:
  DefectFinder(const SurfaceMesh& mesh, const DefectOptions& options) : mesh_(mesh), options_(options) {}

  std::vector<std::string> run() {
    check_indices();
    if (!defects_.empty()) return std::move(defects_);  // the checks below need sound indices
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) check_triangles(f);
    check_duplicates();
    check_unused();
    check_edges();
    if (defects_.empty())
      for (const std::string& sentence : find_cell_defects(mesh_)) add(sentence);
    return std::move(defects_);
  }

  std::vector<std::int32_t> run_joints() {
    check_indices();
    if (!defects_.empty()) return {};
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) check_triangles(f);
    check_duplicates();
    check_edges();
    std::ranges::sort(at_joints_);
    at_joints_.erase(std::unique(at_joints_.begin(), at_joints_.end()), at_joints_.end());
    return std::move(at_joints_);
  }

 private:
  using Key = std::array<std::int32_t, 2>;
  struct EdgeUse {
    Key key;
    std::int32_t face;
    friend auto operator<=>(const EdgeUse&, const EdgeUse&) = default;
  };

  void add(const std::string& sentence) {
    if (defects_.size() < options_.limit) defects_.push_back(sentence);
  }
  [[nodiscard]] bool is_vertex(std::int32_t v) const {
    return v >= 0 && static_cast<std::size_t>(v) < mesh_.vertices.size();
  }
  static bool meshed(const FaceMesh& face) {
    return face.status == FaceStatus::meshed || face.status == FaceStatus::mended;
  }
  static std::string of_face(std::size_t t, const FaceMesh& face) {
    return "triangle " + std::to_string(t) + " of face " + std::to_string(face.shown_ref()) + ": ";
  }
  static Key ordered(std::int32_t a, std::int32_t b) { return a < b ? Key{a, b} : Key{b, a}; }

  template <typename Vertices>
  void add_joint(const std::string& sentence, const Vertices& vertices) {
    add(sentence);
    at_joints_.insert(at_joints_.end(), vertices.begin(), vertices.end());
  }

  void check_indices() {
    check_vertices();
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) check_face(f);
    check_curves_in_range();
  }

  void check_vertices() {
    if (mesh_.vertex_ref.size() != mesh_.vertices.size()) add("vertices and vertex references differ in number");
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
      if (!is_finite(mesh_.vertices[v])) add("vertex " + std::to_string(v) + ": a coordinate is not finite");
  }

  void check_face(std::size_t f) {
    const FaceMesh& face = mesh_.faces[f];
    const std::string name = "face " + std::to_string(face.shown_ref());
    if (!meshed(face) && !face.triangles.empty()) add(name + ": not meshed, yet it has triangles");
    if (meshed(face) && face.triangles.empty()) add(name + ": no triangle");
    if (face.uv.size() != face.vertex.size()) add(name + ": local vertices and (u, v) differ in number");
    for (const std::int32_t v : face.vertex)
      if (!is_vertex(v)) add(name + ": a local vertex has no vertex in space");
    for (const Vec2& p : face.uv)
      if (!is_finite(p)) add(name + ": (u, v) of a vertex is not finite");
    for (std::size_t t = 0; t < face.triangles.size(); ++t)
      for (const std::int32_t v : face.triangles[t])
        if (v < 0 || static_cast<std::size_t>(v) >= face.uv.size())
          add(of_face(t, face) + "a corner that does not exist");
  }

  void check_curves_in_range() {
    for (const CurveMesh& curve : mesh_.curves) {
      const std::string name = "curve of reference " + std::to_string(curve.ref);
      for (const std::int32_t v : curve.vertices)
        if (!is_vertex(v)) add(name + ": a vertex that does not exist");
      for (const CurveMeshUse& use : curve.uses)
        if (use.face < 0 || static_cast<std::size_t>(use.face) >= mesh_.faces.size())
          add(name + ": a face that does not exist");
    }
  }

  void check_triangles(std::size_t f) {
    const FaceMesh& face = mesh_.faces[f];
    std::vector<Key> directed;
    directed.reserve(3 * face.triangles.size());
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
      const auto& [a, b, c] = face.triangles[t];
      const std::int32_t va = face.vertex[a], vb = face.vertex[b], vc = face.vertex[c];
      if (va == vb || vb == vc || vc == va) {
        add(of_face(t, face) + "a vertex appears twice");
        continue;
      }
      if (!face.is_spread(t) && orientation(face.uv[a], face.uv[b], face.uv[c]) <= 0) add(of_face(t, face) + "no positive area in (u, v)");
      if (!(quality_q2(mesh_.vertices[va], mesh_.vertices[vb], mesh_.vertices[vc]) > flat_quality))
        add(of_face(t, face) + "no area in space");
      directed.push_back({a, b});
      directed.push_back({b, c});
      directed.push_back({c, a});
    }
    bucket_sort(directed, face.uv.size(), [](const Key& edge) { return edge[0]; });
    for (std::size_t i = 1; i < directed.size(); ++i)
      if (directed[i] == directed[i - 1])
        add_joint("face " + std::to_string(face.shown_ref()) + ": two triangles run along one edge the same way, near u = " +
                      std::to_string(face.uv[directed[i][0]].x()) + ", v = " + std::to_string(face.uv[directed[i][0]].y()),
                  Key{face.vertex[directed[i][0]], face.vertex[directed[i][1]]});
  }

  void check_duplicates() {
    std::vector<std::array<std::int32_t, 3>> sorted;
    sorted.reserve(mesh_.triangle_count());
    for (const FaceMesh& face : mesh_.faces)
      for (const auto& t : face.triangles) {
        std::array<std::int32_t, 3> corners{face.vertex[t[0]], face.vertex[t[1]], face.vertex[t[2]]};
        std::sort(corners.begin(), corners.end());
        sorted.push_back(corners);
      }
    bucket_sort(sorted, mesh_.vertices.size(), [](const auto& corners) { return corners[0]; });
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i] == sorted[i - 1])
        add_joint("two triangles have the same vertices " + std::to_string(sorted[i][0]) + ", " +
                      std::to_string(sorted[i][1]) + ", " + std::to_string(sorted[i][2]),
                  sorted[i]);
  }

  void check_unused() {
    std::vector<char> used(mesh_.vertices.size(), 0);
    for (const FaceMesh& face : mesh_.faces)
      for (const auto& t : face.triangles)
        for (const std::int32_t v : t) used[face.vertex[v]] = 1;
    // A curve of faces that failed keeps its vertices: a later run starts from them. Wires have edges.
    for (const CurveMesh& curve : mesh_.curves) {
      const bool lost = std::any_of(curve.uses.begin(), curve.uses.end(),
                                    [this](const CurveMeshUse& u) { return !meshed(mesh_.faces[u.face]); });
      if (lost)
        for (const std::int32_t v : curve.vertices) used[v] = 1;
    }
    for (std::size_t v = 0; v < used.size(); ++v)
      if (used[v] == 0) add("vertex " + std::to_string(v) + ": belongs to no triangle");
  }

  // The required positions of edges on curves: one entry a triangle.
  std::vector<EdgeUse> expected_on_curves() {
    std::vector<EdgeUse> expected;
    for (const CurveMesh& curve : mesh_.curves)
      for (std::size_t i = 1; i < curve.vertices.size(); ++i)
        for (const CurveMeshUse& use : curve.uses) {
          if (!meshed(mesh_.faces[use.face])) continue;
          const EdgeUse entry{ordered(curve.vertices[i - 1], curve.vertices[i]), use.face};
          expected.push_back(entry);
          if (use.internal) expected.push_back(entry);
        }
    std::sort(expected.begin(), expected.end());
    return expected;
  }

  void check_edges() {
    std::vector<EdgeUse> found;
    found.reserve(3 * mesh_.triangle_count());
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
      for (const auto& t : mesh_.faces[f].triangles)
        for (int i = 0; i < 3; ++i)
          found.push_back({ordered(mesh_.faces[f].vertex[t[i]], mesh_.faces[f].vertex[t[(i + 1) % 3]]),
                           static_cast<std::int32_t>(f)});
    bucket_sort(found, mesh_.vertices.size(), [](const EdgeUse& e) { return e.key[0]; });
    const std::vector<EdgeUse> expected = expected_on_curves();
    std::size_t i = 0, k = 0;
    while (i < found.size() || k < expected.size()) {
      const EdgeUse edge =
          k == expected.size() || (i < found.size() && found[i] < expected[k]) ? found[i] : expected[k];
      std::size_t have = 0, want = 0;
      while (i < found.size() && found[i] == edge) ++i, ++have;
      while (k < expected.size() && expected[k] == edge) ++k, ++want;
      if (want > 0 ? have == want : have == 2 || mesh_.independent) continue;
      const std::string name = "edge " + std::to_string(edge.key[0]) + " - " + std::to_string(edge.key[1]) +
                               " of face " + std::to_string(mesh_.faces[edge.face].shown_ref()) + ": ";
      if (want > 0)
        add_joint(name + "on a curve, with " + std::to_string(have) + " triangles instead of " + std::to_string(want), edge.key);
      else
        add_joint(name + std::to_string(have) + " triangles away from any curve", edge.key);
    }
    if (mesh_.independent) check_edges_between(found, expected);
    if (options_.closed) check_closed(found);
  }

  // Away from curves two triangles of any faces.
  void check_edges_between(const std::vector<EdgeUse>& found, const std::vector<EdgeUse>& expected) {
    for (std::size_t i = 0; i < found.size();) {
      std::size_t j = i;
      while (j < found.size() && found[j].key == found[i].key) ++j;
      if (j - i != 2 && !std::ranges::binary_search(expected, found[i].key, {}, &EdgeUse::key))
        add_joint("edge " + std::to_string(found[i].key[0]) + " - " + std::to_string(found[i].key[1]) + ": " +
                      std::to_string(j - i) + " triangles away from any curve",
                  found[i].key);
      i = j;
    }
  }

  void check_closed(const std::vector<EdgeUse>& found) {
    for (std::size_t i = 0; i < found.size();) {
      std::size_t j = i;
      while (j < found.size() && found[j].key == found[i].key) ++j;
      if (j - i == 1)
        add("edge " + std::to_string(found[i].key[0]) + " - " + std::to_string(found[i].key[1]) + ": open");
      i = j;
    }
  }

  const SurfaceMesh& mesh_;
  const DefectOptions& options_;
  std::vector<std::string> defects_;
  std::vector<std::int32_t> at_joints_;
};

}  // namespace

std::vector<std::string> find_defects(const SurfaceMesh& mesh, const DefectOptions& options) {
  return DefectFinder(mesh, options).run();
}

std::vector<std::int32_t> find_wrong_joints(const SurfaceMesh& mesh) { return DefectFinder(mesh, {}).run_joints(); }

}  // namespace carreau
