// SPDX-License-Identifier: BSD-3-Clause
// The pairs of vertices of the mesh that is delivered.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "periodic/shared_curves.h"
#include "pipeline/base/run.h"
#include "support/format.h"
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
  explicit Linker(CompositeRun& run) : run_(run), mesh_(run.result.mesh), first_mid_(static_cast<std::int32_t>(mesh_.vertices.size())) {
    if (mesh_.independent) list_curves();
  }

  void run(bool reports) {
    mesh_.periodic.clear();
    add_corners();
    for (const CurveClass& all : run_.periodic.curves)
      for (const CurveMember& member : all.members) add_curve(all, member);
    for (std::size_t i = 0; i < run_.periodic.pairs.size(); ++i) add_face(i);
    if (reports) report();
  }

 private:
  [[nodiscard]] PeriodicLink link(int dimension, int master, int slave, const Isometry& map) const {
    return {.dimension = dimension, .master = master, .slave = slave, .map = map};
  }

  void keep(PeriodicLink linked) {
    sort_uniquely(linked.nodes);
    for (const auto& [slave, master] : linked.nodes)
      worst_ = std::max(worst_, norm(linked.map(position(master)) - position(slave)));
    if (linked.dimension == 2) pairs_ += linked.nodes.size(), ++faces_;
    if (linked.dimension == 1) curve_pairs_ += linked.nodes.size(), ++curves_;
    if (!linked.nodes.empty()) mesh_.periodic.push_back(std::move(linked));
  }

  [[nodiscard]] Vec3 position(std::int32_t node) const {
    return node < first_mid_ ? mesh_.vertices[node] : mesh_.mid_vertices[node - first_mid_];
  }

  // Ends of curves carry corners with them; a map of a corner is the map of one of its curves.
  void add_corners() {
    std::vector<char> done(run_.topology.points.size(), 0);
    for (const CurveClass& all : run_.periodic.curves)
      for (const CurveMember& member : all.members) {
        const int root = all.members.front().image.curve, c = member.image.curve;
        const Curve &from = run_.topology.curves[root], &to = run_.topology.curves[c];
        const bool closed = from.end1 == from.end2;
        if (c == root || (closed && member.image.shift != 0 && !from.degenerate)) continue;
        const bool turned = !closed && member.image.reversed;
        for (const auto& [p, q] : {std::pair(from.end1, turned ? to.end2 : to.end1), std::pair(from.end2, turned ? to.end1 : to.end2)}) {
          if (p == q || done[q] != 0) continue;
          const std::int32_t v = vertex_of(root, p), w = vertex_of(c, q);
          if (v < 0 || w < 0) continue;
          done[q] = 1;
          PeriodicLink linked = link(0, run_.topology.points[p].ref, run_.topology.points[q].ref, member.map);
          linked.nodes.push_back({w, v});
          keep(std::move(linked));
        }
      }
  }

  // Cross-patch remeshing may divide curves where the faces beside change, and turn them round.
  void list_curves() {
    on_curve_.resize(run_.topology.curves.size());
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
      const Vec3& place = run_.topology.points[point].position;
      for (const std::int32_t v : on_curve_[curve])
        if (norm(position(v) - place) <= run_.periodic.gap) return v;
      return -1;
    }
    const std::vector<std::int32_t>& chain = mesh_.curves[curve].vertices;
    if (chain.empty()) return -1;
    return run_.topology.curves[curve].end1 == point ? chain.front() : chain.back();
  }

  void add_curve(const CurveClass& all, const CurveMember& member) {
    const int root = all.members.front().image.curve, c = member.image.curve;
    const Curve& shape = run_.topology.curves[root];
    const CurveMesh &from = mesh_.curves[root], &to = mesh_.curves[c];
    if (c == root || shape.degenerate) return;
    if (mesh_.independent) {
      PeriodicLink linked = link(1, from.shown_ref(), to.shown_ref(), member.map);
      link_by_places(on_curve_[root], on_curve_[c], linked);
      return;
    }
    if (from.vertices.size() != to.vertices.size() || from.vertices.empty()) return;
    if (from.vertices.size() != run_.curves[root].xyz.size()) return;
    const std::vector<std::int32_t>&vertices = from.vertices, &images = to.vertices;
    const bool closed = shape.end1 == shape.end2;
    PeriodicLink linked = link(1, from.shown_ref(), to.shown_ref(), member.map);
    const auto n = static_cast<int>(from.vertices.size()) - 1;
    std::vector<int> image;
    for (int k = 0; k <= n; ++k) {
      image.push_back(vertex_image(run_.curves[root], run_.curves[c], member.image, closed, k));
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

  void add_face(std::size_t index) {
    const FacePair& pair = run_.periodic.pairs[index];
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
    const double gap = run_.periodic.gap, width = 4 * gap;
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

  void report() {
    const bool plane = faces_ == 0;
    const std::size_t count = plane ? curves_ : faces_;
    if (count == 0) return;
    run_.monitor.message(Level::summary, "periodic: " + std::to_string(count) + (count == 1 ? " pair" : " pairs") +
                                             (plane ? " of curves, " : " of faces, ") + std::to_string(plane ? curve_pairs_ : pairs_) + " pairs of vertices, " + format_number(worst_) +
                                             " apart at most");
  }

  CompositeRun& run_;
  SurfaceMesh& mesh_;
  std::int32_t first_mid_;
  std::vector<std::vector<std::int32_t>> on_curve_;  // of a cross-patch mesh: vertices and nodes, by curve of the topology
  double worst_ = 0;
  std::size_t faces_ = 0, pairs_ = 0, curve_pairs_ = 0, curves_ = 0;
};

}  // namespace

void link_periodic(CompositeRun& run, bool reports) {
  if (!run.periodic.empty()) Linker(run).run(reports);
}

}  // namespace carreau
