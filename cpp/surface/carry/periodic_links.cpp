// SPDX-License-Identifier: BSD-3-Clause
#include "surface/carry/periodic_links.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "periodic/root_maps.h"
#include "periodic/shared_curves.h"
#include "surface/carry/carry_patch.h"

namespace carreau {

namespace {

using Nodes = std::vector<std::array<std::int32_t, 2>>;

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
    for (const CurveClass& all : periodic_.curves) add_cycle(all);
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

  // Ends of curves carry corners with them; a map of a corner is the map of one of its curves.
  void add_corners() {
    std::vector<char> done(topology_.points.size(), 0);
    for (const CurveClass& all : periodic_.curves)
      for (const CurveMember& member : all.members) {
        const int root = all.members.front().image.curve, c = member.image.curve;
        const Curve &from = topology_.curves[root], &to = topology_.curves[c];
        const bool closed = from.end1 == from.end2;
        if (c == root || (closed && member.image.shift != 0 && !from.degenerate)) continue;
        const bool turned = !closed && member.image.reversed;
        for (const auto& [p, q] : {std::pair(from.end1, turned ? to.end2 : to.end1), std::pair(from.end2, turned ? to.end1 : to.end2)}) {
          if (p == q || done[q] != 0) continue;
          const std::int32_t v = vertex_of(root, p), w = vertex_of(c, q);
          if (v < 0 || w < 0) continue;
          done[q] = 1;
          PeriodicLink linked = link(0, topology_.points[p].ref, topology_.points[q].ref, member.map);
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
    const Curve& shape = topology_.curves[root];
    const CurveMesh &from = mesh_.curves[root], &to = mesh_.curves[c];
    if (c == root || shape.degenerate) return;
    if (mesh_.independent) {
      PeriodicLink linked = link(1, from.shown_ref(), to.shown_ref(), member.map);
      link_by_places(on_curve_[root], on_curve_[c], linked);
      return;
    }
    if (from.vertices.size() != to.vertices.size() || from.vertices.empty()) return;
    if (from.vertices.size() != curves_[root].xyz.size()) return;
    const std::vector<std::int32_t>&vertices = from.vertices, &images = to.vertices;
    const bool closed = shape.end1 == shape.end2;
    PeriodicLink linked = link(1, from.shown_ref(), to.shown_ref(), member.map);
    const auto n = static_cast<int>(from.vertices.size()) - 1;
    std::vector<int> image;
    for (int k = 0; k <= n; ++k) {
      image.push_back(vertex_image(curves_[root], curves_[c], member.image, closed, k));
      if (image.back() < 0) return;
      linked.nodes.push_back({images[image.back()], vertices[k]});
    }
    for (int k = 0; k < n && !from.mid.empty(); ++k) {
      const int i = image[k] % n, j = image[k + 1] % n;
      const int segment = (i + 1) % n == j && !(n == 1 && member.image.reversed) ? i : j;
      linked.nodes.push_back({first_mid_ + to.mid[n == 1 ? 0 : segment], first_mid_ + from.mid[k]});
    }
    keep(std::move(linked));
  }

  // A closed curve that maps carry onto itself: images of the vertices of its first arc.
  void add_cycle(const CurveClass& all) {
    const int root = all.members.front().image.curve;
    const CurveMesh& curve = mesh_.curves[root];
    if (all.cycle.is_trivial() || mesh_.independent || curve.vertices.size() != curves_[root].xyz.size()) return;
    const auto n = static_cast<std::size_t>(curves_[root].segments());
    std::vector<char> known(n, 0);
    const std::vector<CurveMember> maps = maps_of_root(all);
    std::vector<PeriodicLink> links;
    for (const CurveMember& each : maps) links.push_back(link(1, curve.shown_ref(), curve.shown_ref(), each.map));
    for (std::size_t v = 0; v < n; ++v) {
      if (known[v] != 0) continue;
      known[v] = 1;
      for (std::size_t m = 0; m < maps.size(); ++m) {
        const int w = vertex_image(curves_[root], curves_[root], maps[m].image, true, static_cast<int>(v)) % static_cast<int>(n);
        if (w < 0 || known[w] != 0) continue;
        known[w] = 1;
        links[m].nodes.push_back({curve.vertices[w], curve.vertices[v]});
      }
    }
    for (PeriodicLink& each : links)
      if (!each.nodes.empty()) keep(std::move(each));
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
    const double gap = periodic_.gap, width = 4 * gap;
    using Cell = std::array<std::int64_t, 3>;
    const auto cell_of = [width](const Vec3& p) -> Cell {
      return {std::llround(p.x() / width), std::llround(p.y() / width), std::llround(p.z() / width)};
    };
    std::map<Cell, std::vector<std::int32_t>> slaves;
    for (const std::int32_t v : to) slaves[cell_of(position(v))].push_back(v);
    for (const std::int32_t v : from) {
      const Vec3 image = linked.map(position(v));
      std::set<Cell> cells;
      for (int corner = 0; corner < 8; ++corner)
        cells.insert(cell_of(image + gap * Vec3((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1)));
      for (const Cell& cell : cells)
        if (const auto found = slaves.find(cell); found != slaves.end())
          for (const std::int32_t w : found->second)
            if (norm(position(w) - image) <= gap && (w < first_mid_) == (v < first_mid_)) linked.nodes.push_back({w, v});
    }
    keep(std::move(linked));
  }

  const PeriodicModel& periodic_;
  const Topology& topology_;
  const std::vector<DiscreteCurve>& curves_;
  SurfaceMesh& mesh_;
  std::int32_t first_mid_;
  std::vector<std::vector<std::int32_t>> on_curve_;  // of a cross-patch mesh: vertices and nodes, by curve of the topology
  LinkFigures figures_;
};

}  // namespace

LinkFigures link_nodes(const PeriodicModel& periodic, const Topology& topology, const std::vector<DiscreteCurve>& curves, SurfaceMesh& mesh) {
  return Linker(periodic, topology, curves, mesh).run();
}

}  // namespace carreau
