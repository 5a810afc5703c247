// SPDX-License-Identifier: BSD-3-Clause
#include "surface/carry/periodic_links.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "model/nodes_by_place.h"
#include "periodic/root_maps.h"
#include "periodic/shared_curves.h"
#include "surface/carry/carry_patch.h"

namespace carreau {

namespace {

using Nodes = NodeImages;

void sort_uniquely(Nodes& nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

class Linker {
 public:
  Linker(const PeriodicModel& periodic, const Topology& topology, const std::vector<DiscreteCurve>& curves, SurfaceMesh& mesh)
      : periodic_(periodic), topology_(topology), curves_(curves), mesh_(mesh), first_mid_(static_cast<std::int32_t>(mesh_.vertices.size())) {
    if (mesh_.independent) list_curves();
  }

  LinkFigures run() {
    mesh_.periodic.clear();
    add_corners();
    for (const CurveClass& all : periodic_.curves)
      for (const CurveMember& member : all.members) add_curve(all, member);
    for (const CurveClass& all : periodic_.curves) add_itself(all);
    for (std::size_t i = 0; i < periodic_.pairs.size(); ++i) add_face(i);
    return figures_;
  }

 private:
  [[nodiscard]] PeriodicLink link(int dimension, int master, int slave, const Isometry& map) const {
    return {.dimension = dimension, .master = master, .slave = slave, .map = map};
  }

  void keep(PeriodicLink linked) {
    sort_uniquely(linked.nodes);
    for (const auto& [slave, master] : linked.nodes)
      figures_.worst = std::max(figures_.worst, norm(linked.map(position(master)) - position(slave)));
    if (linked.dimension == 2) figures_.nodes_of_faces += linked.nodes.size(), ++figures_.faces;
    if (linked.dimension == 1) figures_.nodes_of_curves += linked.nodes.size(), ++figures_.curves;
    if (!linked.nodes.empty()) mesh_.periodic.push_back(std::move(linked));
  }

  [[nodiscard]] Vec3 position(std::int32_t node) const {
    return node < first_mid_ ? mesh_.vertices[node] : mesh_.mid_vertices[node - first_mid_];
  }

  // The first corner of a class is the master of all others.
  void add_corners() {
    std::vector<int> curve_at(topology_.points.size(), -1);
    for (const CurveClass& all : periodic_.curves)
      for (const CurveMember& member : all.members) {
        const Curve& curve = topology_.curves[member.image.curve];
        curve_at[curve.end1] = curve_at[curve.end2] = member.image.curve;
      }
    for (std::size_t c = 0; c < periodic_.corners.size(); ++c) {
      const std::vector<int>& corners = periodic_.corners[c];
      const std::int32_t v = vertex_of(curve_at[corners.front()], corners.front());
      for (std::size_t k = 1; k < corners.size() && v >= 0; ++k) {
        const std::int32_t w = vertex_of(curve_at[corners[k]], corners[k]);
        if (w < 0) continue;
        PeriodicLink linked = link(0, topology_.points[corners.front()].ref, topology_.points[corners[k]].ref, periodic_.corner_maps[c][k]);
        linked.nodes.push_back({w, v});
        keep(std::move(linked));
      }
    }
  }

  // Cross-patch remeshing may divide curves where the faces beside change, and turn them round.
  void list_curves() {
    on_curve_.resize(topology_.curves.size());
    std::map<int, std::size_t> by_ref;
    for (std::size_t c = 0; c < on_curve_.size(); ++c) by_ref.emplace(mesh_.curves[c].ref, c);
    for (std::size_t k = 0; k < mesh_.curves.size(); ++k) {
      std::vector<std::int32_t>& all = on_curve_[k < on_curve_.size() ? k : by_ref.at(mesh_.curves[k].ref)];
      all.insert(all.end(), mesh_.curves[k].vertices.begin(), mesh_.curves[k].vertices.end());
      for (const std::int32_t m : mesh_.curves[k].mid) all.push_back(first_mid_ + m);
    }
  }

  [[nodiscard]] std::int32_t vertex_of(int curve, int point) const {
    if (curve < 0) return -1;
    if (mesh_.independent) {
      const Vec3& place = topology_.points[point].position;
      for (const std::int32_t v : on_curve_[curve])
        if (norm(position(v) - place) <= periodic_.gap) return v;
      return -1;
    }
    const std::vector<std::int32_t>& chain = mesh_.curves[curve].vertices;
    if (chain.empty()) return -1;
    return topology_.curves[curve].end1 == point ? chain.front() : chain.back();
  }

  void add_curve(const CurveClass& all, const CurveMember& member) {
    const int root = all.members.front().image.curve, c = member.image.curve;
    const CurveMesh &from = mesh_.curves[root], &to = mesh_.curves[c];
    if (c == root || topology_.curves[root].degenerate) return;
    if (mesh_.independent) {
      PeriodicLink linked = link(1, from.shown_ref(), to.shown_ref(), member.map);
      link_by_places(on_curve_[root], on_curve_[c], linked);
      return;
    }
    PeriodicLink linked = link(1, from.shown_ref(), to.shown_ref(), member.map);
    for (const auto& [v, w] : images_on_curve(root, member.image)) linked.nodes.push_back({w, v});
    keep(std::move(linked));
  }

  // Nodes of a root with their images on a curve of its class; none where the mesh has other vertices than the curves.
  [[nodiscard]] Nodes images_on_curve(int root, const CurveImage& onto) const {
    const Curve& shape = topology_.curves[root];
    const CurveMesh &from = mesh_.curves[root], &to = mesh_.curves[onto.curve];
    if (from.vertices.size() != to.vertices.size() || from.vertices.empty() || from.vertices.size() != curves_[root].xyz.size()) return {};
    const bool closed = shape.end1 == shape.end2;
    const auto n = static_cast<int>(from.vertices.size()) - 1;
    Nodes nodes;
    std::vector<int> image;
    for (int k = 0; k <= n; ++k) {
      image.push_back(vertex_image(curves_[root], curves_[onto.curve], onto, closed, k));
      if (image.back() < 0) return {};
      nodes.push_back({from.vertices[k], to.vertices[image.back()]});
    }
    for (int k = 0; k < n && !from.mid.empty(); ++k) {
      const int i = image[k] % n, j = image[k + 1] % n;
      const int segment = (i + 1) % n == j && !(n == 1 && onto.reversed) ? i : j;
      nodes.push_back({first_mid_ + from.mid[k], first_mid_ + to.mid[n == 1 ? 0 : segment]});
    }
    return nodes;
  }

  // A curve that maps carry onto itself: the first node of each orbit is the master of the others.
  void add_itself(const CurveClass& all) {
    const int root = all.members.front().image.curve;
    const std::vector<CurveMember> maps = maps_of_root(all);
    if (maps.empty() || topology_.curves[root].degenerate) return;
    const CurveMesh& curve = mesh_.curves[root];
    std::vector<Nodes> images;
    if (mesh_.independent) {
      const NodesByPlace places(on_curve_[root], positions_, first_mid_, periodic_.gap);
      for (const CurveMember& each : maps) {
        Nodes& nodes = images.emplace_back();
        for (const std::int32_t v : on_curve_[root])
          places.for_near(each.map(position(v)), v, [&](std::int32_t w) { nodes.push_back({v, w}); });
      }
    } else {
      for (const CurveMember& each : maps) images.push_back(images_on_curve(root, each.image));
    }
    const std::vector<Nodes> pairs = pairs_of_orbits(images);
    for (std::size_t m = 0; m < maps.size(); ++m) {
      PeriodicLink linked = link(1, curve.shown_ref(), curve.shown_ref(), maps[m].map);
      linked.nodes = pairs[m];
      if (!linked.nodes.empty()) keep(std::move(linked));
    }
  }

  void add_face(std::size_t index) {
    const FacePair& pair = periodic_.pairs[index];
    const FaceMesh &from = mesh_.faces[pair.master], &to = mesh_.faces[pair.slave];
    PeriodicLink linked = link(2, from.shown_ref(), to.shown_ref(), pair.map);
    const bool flipped = pair.flipped;
    if (mesh_.independent) {
      link_by_places(nodes_of(from), nodes_of(to), linked);
      return;
    }
    if (from.triangles.size() != to.triangles.size()) return;
    for (std::size_t t = 0; t < from.triangles.size(); ++t) {
      const std::size_t u = image_triangle(from, t, flipped);
      for (std::size_t i = 0; i < 3; ++i) {
        linked.nodes.push_back({to.vertex[to.triangles[u][flipped ? (3 - i) % 3 : i]], from.vertex[from.triangles[t][i]]});
        if (from.mid.empty() || from.mid[t][i] < 0) continue;
        linked.nodes.push_back({first_mid_ + to.mid_vertex[to.mid[u][flipped ? 2 - i : i]], first_mid_ + from.mid_vertex[from.mid[t][i]]});
      }
    }
    keep(std::move(linked));
  }

  [[nodiscard]] std::vector<std::int32_t> nodes_of(const FaceMesh& face) const {
    std::vector<std::int32_t> nodes = face.vertex;
    for (const std::int32_t m : face.mid_vertex) nodes.push_back(first_mid_ + m);
    return nodes;
  }

  // Cross-patch meshes have their elements in another order. Vertices are images of vertices, nodes on edges of nodes.
  void link_by_places(const std::vector<std::int32_t>& from, const std::vector<std::int32_t>& to, PeriodicLink& linked) {
    const NodesByPlace places(to, positions_, first_mid_, periodic_.gap);
    for (const std::int32_t v : from) places.for_near(linked.map(position(v)), v, [&](std::int32_t w) { linked.nodes.push_back({w, v}); });
    keep(std::move(linked));
  }

  const PeriodicModel& periodic_;
  const Topology& topology_;
  const std::vector<DiscreteCurve>& curves_;
  SurfaceMesh& mesh_;
  std::int32_t first_mid_;
  NodesByPlace::Positions positions_ = [this](std::int32_t node) { return position(node); };
  std::vector<std::vector<std::int32_t>> on_curve_;  // of a cross-patch mesh: vertices and nodes, by curve of the topology
  LinkFigures figures_;
};

}  // namespace

LinkFigures link_nodes(const PeriodicModel& periodic, const Topology& topology, const std::vector<DiscreteCurve>& curves, SurfaceMesh& mesh) {
  return Linker(periodic, topology, curves, mesh).run();
}

}  // namespace carreau
