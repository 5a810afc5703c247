// SPDX-License-Identifier: BSD-3-Clause
#include "projection/mesh_association.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <type_traits>
#include <utility>

#include "support/infinity.h"

namespace carreau {

namespace {

/// The first record of a node on an entity; null: there is none.
template <typename Record>
const Record* first_of(const std::vector<Record>& records, std::int32_t node, std::int32_t ref) {
  const auto found = std::lower_bound(records.begin(), records.end(), std::pair(node, ref),
                                      [](const Record& record, const auto& key) { return std::pair(record.node, record.ref) < key; });
  return found != records.end() && found->node == node && found->ref == ref ? &*found : nullptr;
}

}  // namespace

std::span<const double> MeshAssociation::parameters(int dimension, std::int32_t node, std::int32_t ref) const {
  if (dimension == 1)
    if (const OnCurve* const on = first_of(curves, node, ref)) return {&on->t, 1};
  if (dimension == 2)
    if (const OnFace* const on = first_of(faces, node, ref)) return {on->uv.data(), 2};
  return {};
}

void MeshAssociation::sort() {
  const auto key = [](const auto& record) {
    using Record = std::decay_t<decltype(record)>;
    if constexpr (std::is_same_v<Record, OnPoint>)
      return std::tuple(record.node, record.ref);
    else if constexpr (std::is_same_v<Record, OnCurve>)
      return std::tuple(record.node, record.ref, record.t);
    else
      return std::tuple(record.node, record.ref, record.uv.x(), record.uv.y());
  };
  const auto sorted = [&](auto& records) {
    std::sort(records.begin(), records.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    records.erase(std::unique(records.begin(), records.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }), records.end());
  };
  sorted(points), sorted(curves), sorted(faces);
}

MeshAssociation associate(const SurfaceMesh& mesh, std::span<const CurveParameters> curves, std::span<const std::vector<double>> mid_t,
                          const std::function<std::int32_t(std::int32_t)>& shown_point,
                          const std::function<std::size_t(std::size_t face, std::int32_t node)>& uv_face) {
  MeshAssociation all;
  const auto corners = static_cast<std::int32_t>(mesh.vertices.size());
  all.entities.assign(mesh.vertices.size() + mesh.mid_vertices.size(), MeshEntity{});
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceMesh& face = mesh.faces[f];
    const auto put = [&](std::int32_t node, std::size_t k, const Vec2& uv) {
      const std::int32_t ref = mesh.faces[uv_face(f, static_cast<std::int32_t>(k))].shown_ref();
      if (all.entities[node].ref == 0) all.entities[node].ref = ref;
      if (is_finite(uv)) all.faces.push_back({node, ref, uv});
    };
    for (std::size_t k = 0; k < face.uv.size(); ++k) put(face.vertex[k], k, face.uv[k]);
    for (std::size_t k = 0; k < face.mid_uv.size(); ++k) put(corners + face.mid_vertex[k], face.uv.size() + k, face.mid_uv[k]);
    for (const Cell& cell : local_cells(face))
      for (int i = 0; i < node_count(cell.kind); ++i) {
        const auto k = static_cast<std::size_t>(cell.nodes[i]);
        all.cell_uv.push_back(k < face.uv.size() ? face.uv[k] : face.mid_uv[k - face.uv.size()]);
        if (mesh.independent) all.cell_faces.push_back(mesh.faces[uv_face(f, cell.nodes[i])].shown_ref());
      }
  }
  NodesOfCurves nodes(all.entities.size());
  for (std::size_t c = 0; c < mesh.curves.size(); ++c) {
    const CurveMesh& curve = mesh.curves[c];
    const std::int32_t ref = curve.shown_ref();
    const auto put = [&](std::int32_t node, double t) {
      if (nodes.takes(static_cast<std::size_t>(node), all.entities[node], t)) all.entities[node] = {1, ref};
      if (std::isfinite(t)) all.curves.push_back({node, ref, t});
    };
    const bool known = c < curves.size() && curves[c].t.size() == curve.vertices.size();
    for (std::size_t k = 0; k < curve.vertices.size(); ++k) put(curve.vertices[k], known ? curves[c].t[k] : nan);
    for (std::size_t k = 0; k < curve.mid.size(); ++k)
      if (curve.mid[k] >= 0) put(corners + curve.mid[k], c < mid_t.size() && k < mid_t[c].size() ? mid_t[c][k] : nan);
  }
  for (std::int32_t v = 0; v < corners; ++v)
    if (const std::int32_t ref = mesh.vertex_ref[v]; ref != 0) {
      all.entities[v] = {0, shown_point(ref)};
      all.points.push_back({v, shown_point(ref)});
    }
  all.sort();
  return all;
}

}  // namespace carreau
