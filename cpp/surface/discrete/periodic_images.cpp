// SPDX-License-Identifier: BSD-3-Clause
#include "surface/discrete/periodic_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "mesh/triangle_search.h"
#include "model/format_point.h"
#include "support/error.h"
#include "support/format.h"
#include "support/short_number.h"
#include "surface/assembly/whole_mesh.h"
#include "surface/carry/carry_faces.h"

namespace carreau {

namespace {

// Share of the size. Smooth curves and patches of both sides may differ by it, since their tangents depend on the triangles beside.
constexpr double max_miss = 0.1;

/// The triangles of a face of the atlas.
struct FaceSearch {
  std::vector<std::int32_t> triangles;  // of the atlas
  TriangleSearch search;
};

double size_on(const std::vector<double>& arcs, const std::vector<std::int32_t>& chain, std::span<const double> size, double arc) {
  const auto next = std::clamp<std::ptrdiff_t>(std::ranges::upper_bound(arcs, arc) - arcs.begin(), 1, std::ssize(arcs) - 1);
  const double share = std::clamp((arc - arcs[next - 1]) / (arcs[next] - arcs[next - 1]), 0., 1.);
  return (1 - share) * size[chain[next - 1]] + share * size[chain[next]];
}

std::vector<double> shares_of(const SurfaceMesh& mesh, const std::vector<std::int32_t>& chain) {
  std::vector<double> arcs{0};
  for (std::size_t k = 1; k < chain.size(); ++k) arcs.push_back(arcs.back() + norm(mesh.vertices[chain[k]] - mesh.vertices[chain[k - 1]]));
  for (double& arc : arcs) arc /= arcs.back();
  return arcs;
}

/// A vertex of a line, or a node on one of its edges.
struct LineNodeOf {
  std::int32_t index = -1;
  bool is_mid = false;
  friend auto operator<=>(const LineNodeOf&, const LineNodeOf&) = default;
};

/// Replaces faces and links vertices.
class Maker {
 public:
  Maker(const PeriodicTriangles& periodic, Cad& cad, CompositeResult& result, Monitor& monitor)
      : periodic_(periodic), cad_(cad), result_(result), mesh_(result.mesh), monitor_(monitor) {}

  void run() {
    for (const TrianglePair& pair : periodic_.lines) link_line(pair);
    place_images();
    for (const TrianglePair& pair : periodic_.faces) {
      monitor_.checkpoint();
      replace_face(pair);
    }
    drop_former();
    report();
  }

 private:
  void link_line(const TrianglePair& pair) {
    const std::vector<std::int32_t>&from = mesh_.curves[pair.master].vertices, &to = mesh_.curves[pair.slave].vertices;
    double worst = 0;  // in sizes
    const bool same = from.size() == to.size();
    for (std::size_t k = 0; same && k < from.size(); ++k) {
      image_[{{from[k], false}, {to[k], false}}] = pair.map;
      worst = std::max(worst, norm(pair.map(mesh_.vertices[from[k]]) - mesh_.vertices[to[k]]) / result_.vertex_size[to[k]]);
    }
    const std::vector<std::int32_t>&mids = mesh_.curves[pair.master].mid, &images = mesh_.curves[pair.slave].mid;
    for (std::size_t k = 0; same && k < mids.size() && mids.size() == images.size(); ++k) image_[{{mids[k], true}, {images[k], true}}] = pair.map;
    if (!same || worst > max_miss)
      throw InvalidModel("lines of the triangles that are periodic could not be divided alike, near " + format_point(mesh_.vertices[to.front()]) + ": " +
                         std::to_string(from.size() - 1) + " and " + std::to_string(to.size() - 1) + " edges, " + short_number(worst) + " sizes apart");
  }

  // Smooth curves of triangles depend on the triangles of one side: the image is as good a place.
  void place_images() {
    std::map<LineNodeOf, std::vector<std::pair<LineNodeOf, Isometry>>> steps;
    for (const auto& [vertices, map] : image_) {
      steps[vertices.first].push_back({vertices.second, map});
      steps[vertices.second].push_back({vertices.first, map.inverse()});
    }
    std::set<LineNodeOf> placed;
    for (const auto& [root, first] : steps) {
      if (!placed.insert(root).second) continue;
      std::vector<LineNodeOf> reached{root};
      for (std::size_t i = 0; i < reached.size(); ++i)
        for (const auto& [to, map] : steps.at(reached[i])) {
          if (!placed.insert(to).second) continue;
          position(to) = map(position(reached[i]));
          reached.push_back(to);
        }
    }
    for (const auto& [vertices, map] : image_)
      worst_ = std::max(worst_, norm(map(position(vertices.first)) - position(vertices.second)));
  }

  [[nodiscard]] Vec3& position(const LineNodeOf& node) { return node.is_mid ? mesh_.mid_vertices[node.index] : mesh_.vertices[node.index]; }

  FaceSearch& search_of(int face) {
    const auto known = searches_.find(face);
    if (known != searches_.end()) return known->second;
    FaceSearch& made = searches_[face];
    std::vector<Vec3> vertices;
    std::vector<std::array<std::int32_t, 3>> triangles;
    const std::vector<Charts::Triangle>& all = result_.atlas->triangles();
    for (std::size_t t = 0; t < all.size(); ++t) {
      if (all[t].face != face) continue;
      const auto first = static_cast<std::int32_t>(vertices.size());
      for (int k = 0; k < 3; ++k) vertices.push_back(result_.atlas->xyz(all[t].vertex[k]));
      made.triangles.push_back(static_cast<std::int32_t>(t)), triangles.push_back({first, first + 1, first + 2});
    }
    made.search = TriangleSearch(vertices, triangles, &monitor_);
    return made;
  }

  [[nodiscard]] SurfacePlace closest(int face, const Vec3& target) {
    const FaceSearch& search = search_of(face);
    const NearestOnMesh near = search.search.nearest(target);
    const std::int32_t t = search.triangles[near.triangle];
    Foot foot{t, Vec2(0, 0)};
    for (int k = 0; k < 3; ++k) foot.uv += near.weight[k] * result_.atlas->uv(t, k);
    const SurfacePlace place = result_.atlas->evaluate(cad_, foot);
    if (!(norm(place.xyz - target) > 0) || !place.regular) return place;
    const std::optional<SurfacePlace> better = result_.atlas->towards(cad_, place, target);
    return better && result_.atlas->face(better->foot) == face && norm(better->xyz - target) < norm(place.xyz - target) ? *better : place;
  }

  /// The image of a list of local vertices or nodes.
  struct Images {
    std::vector<Vec2> uv;
    std::vector<std::int32_t> number, feet;
  };

  // `on_lines`: known images.
  Images images_of(const TrianglePair& pair, const std::vector<std::int32_t>& nodes, bool mids, const std::map<LineNodeOf, LineNodeOf>& on_lines) {
    Images made;
    std::map<std::int32_t, std::int32_t> number;  // of the slave's nodes, by node of the master
    for (const std::int32_t x : nodes) {
      const Vec3 target = pair.map(position({x, mids}));
      const SurfacePlace place = closest(pair.slave, target);
      if (const auto known = on_lines.find({x, mids}); known != on_lines.end()) {
        made.number.push_back(known->second.index);
      } else if (const auto again = number.find(x); again != number.end()) {
        made.number.push_back(again->second);
      } else {
        require_near(pair, norm(place.xyz - target), mids ? 0 : result_.vertex_size[x], target);
        std::vector<Vec3>& all = mids ? mesh_.mid_vertices : mesh_.vertices;
        made.number.push_back(number[x] = static_cast<std::int32_t>(all.size()));
        all.push_back(target);
        if (!mids) mesh_.vertex_ref.push_back(0), result_.vertex_size.push_back(result_.vertex_size[x]);
      }
      made.uv.push_back(place.foot.uv), made.feet.push_back(place.foot.triangle);
    }
    return made;
  }

  // Nodes are near if the vertices of their edges are.
  void require_near(const TrianglePair& pair, double apart, double size, const Vec3& at) const {
    if (size == 0 || apart <= std::max(periodic_.gap, max_miss * size)) return;
    throw InvalidModel(Where{.face = mesh_.faces[pair.slave].ref}, "the image of the mesh of face " + std::to_string(mesh_.faces[pair.master].ref) + " is " +
                                                                       short_number(apart) + " away from the triangles at " + format_point(at));
  }

  void replace_face(const TrianglePair& pair) {
    const FaceMesh& from = mesh_.faces[pair.master];
    FaceMesh& to = mesh_.faces[pair.slave];
    std::map<LineNodeOf, LineNodeOf> on_lines = chained(pair.map);  // nodes of the master to nodes of the slave
    for (const bool mids : {false, true}) {  // on axes and in mirror planes
      const std::vector<std::int32_t>&mine = mids ? from.mid_vertex : from.vertex, &others = mids ? to.mid_vertex : to.vertex;
      const std::set<std::int32_t> of_slave(others.begin(), others.end());
      for (const std::int32_t v : mine)
        if (of_slave.contains(v) && norm(pair.map(position({v, mids})) - position({v, mids})) <= periodic_.gap) on_lines.emplace(LineNodeOf{v, mids}, LineNodeOf{v, mids});
    }
    FaceMesh made;
    made.ref = to.ref, made.name = to.name, made.rgb = to.rgb, made.status = to.status, made.why = to.why, made.part_of = to.part_of;
    Images vertices = images_of(pair, from.vertex, false, on_lines), mids = images_of(pair, from.mid_vertex, true, on_lines);
    made.uv = std::move(vertices.uv), made.vertex = std::move(vertices.number), made.uv_face.assign(made.vertex.size(), pair.slave);
    made.mid_uv = std::move(mids.uv), made.mid_vertex = std::move(mids.number);
    const bool turned = turns_over(pair, from, to, on_lines);
    std::vector<std::int32_t> local;
    for (std::size_t v = 0; v < from.vertex.size(); ++v) local.push_back(static_cast<std::int32_t>(v));
    carry_elements(from, local, turned, made);
    carry_mids(from, turned, made);
    const std::vector<std::int32_t>& feet = vertices.feet;
    for (const auto& t : made.triangles) made.spread.push_back(feet[t[0]] == feet[t[1]] && feet[t[1]] == feet[t[2]] ? 0 : 1);
    PeriodicLink& link = mesh_.periodic.emplace_back(PeriodicLink{.dimension = 2, .master = from.shown_ref(), .slave = to.shown_ref(), .map = pair.map});
    for (std::size_t v = 0; v < from.vertex.size(); ++v) link.nodes.push_back({made.vertex[v], from.vertex[v]});
    // Nodes are numbered behind the vertices when all are known: they are negative until then.
    for (std::size_t v = 0; v < from.mid_vertex.size(); ++v) link.nodes.push_back({~made.mid_vertex[v], ~from.mid_vertex[v]});
    to = std::move(made);
    result_.feet[pair.slave] = std::move(vertices.feet);
    if (!from.mid_vertex.empty()) result_.mid_feet[pair.slave] = std::move(mids.feet);
  }

  static bool same_map(const Isometry& a, const Isometry& b) {
    double apart = norm(a.shift - b.shift) / (1 + norm(a.shift));
    for (int i = 0; i < 3; ++i) apart = std::max(apart, norm(a.row[i] - b.row[i]));
    return apart <= 1e-9;
  }

  // Vertices of lines whose maps together are the map: the roots of classes lie between them.
  [[nodiscard]] std::map<LineNodeOf, LineNodeOf> chained(const Isometry& map) const {
    std::map<LineNodeOf, std::vector<std::pair<LineNodeOf, Isometry>>> of_root;
    for (const auto& [nodes, known] : image_) of_root[nodes.first].push_back({nodes.second, known});
    std::map<LineNodeOf, LineNodeOf> found;
    for (auto& [root, members] : of_root) {
      members.push_back({root, {}});
      for (const auto& [master, first] : members)
        for (const auto& [slave, second] : members)
          if (same_map(map.after(first), second)) found.emplace(master, slave);
    }
    return found;
  }

  // An edge of a line runs in the master's triangles as its image does in the slave's, or against it.
  [[nodiscard]] static bool turns_over(const TrianglePair& pair, const FaceMesh& from, const FaceMesh& to, const std::map<LineNodeOf, LineNodeOf>& on_lines) {
    std::set<std::array<std::int32_t, 2>> edges;
    for (const auto& t : to.triangles)
      for (std::size_t i = 0; i < 3; ++i) edges.insert({to.vertex[t[i]], to.vertex[t[(i + 1) % 3]]});
    for (const auto& t : from.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto a = on_lines.find({from.vertex[t[i]], false}), b = on_lines.find({from.vertex[t[(i + 1) % 3]], false});
        if (a == on_lines.end() || b == on_lines.end()) continue;
        const bool along = edges.contains({a->second.index, b->second.index}), against = edges.contains({b->second.index, a->second.index});
        if (along != against) return against;
      }
    return pair.map.reflects();
  }

  // The former vertices and nodes of slaves.
  void drop_former() {
    const NewNumbers now = drop_unused(result_);
    const auto first_mid = static_cast<std::int32_t>(mesh_.vertices.size());
    for (PeriodicLink& link : mesh_.periodic)
      for (auto& pair : link.nodes)
        for (std::int32_t& node : pair) node = node >= 0 ? now.vertex[node] : first_mid + now.mid[~node];
  }

  void report() {
    std::vector<PeriodicLink> faces = std::move(mesh_.periodic);
    mesh_.periodic.clear();
    std::set<std::int32_t> ends;
    for (const TrianglePair& pair : periodic_.lines) {
      const std::vector<std::int32_t>&from = mesh_.curves[pair.master].vertices, &to = mesh_.curves[pair.slave].vertices;
      for (const bool last : {false, true}) {
        const std::int32_t v = last ? from.back() : from.front(), w = last ? to.back() : to.front();
        if (v == w || mesh_.vertex_ref[v] == 0 || mesh_.vertex_ref[w] == 0 || !ends.insert(w).second) continue;
        mesh_.periodic.push_back({.dimension = 0, .master = mesh_.vertex_ref[v], .slave = mesh_.vertex_ref[w], .map = pair.map, .nodes = {{w, v}}});
      }
    }
    std::size_t nodes = 0;
    for (const TrianglePair& pair : periodic_.lines) {
      const CurveMesh &from = mesh_.curves[pair.master], &to = mesh_.curves[pair.slave];
      PeriodicLink link{.dimension = 1, .master = from.shown_ref(), .slave = to.shown_ref(), .map = pair.map};
      for (std::size_t k = 0; k < from.vertices.size(); ++k) link.nodes.push_back({to.vertices[k], from.vertices[k]});
      const auto first_mid = static_cast<std::int32_t>(mesh_.vertices.size());
      for (std::size_t k = 0; k < from.mid.size() && from.mid.size() == to.mid.size(); ++k) link.nodes.push_back({first_mid + to.mid[k], first_mid + from.mid[k]});
      nodes += faces.empty() ? from.vertices.size() : 0;
      mesh_.periodic.push_back(std::move(link));
    }
    for (PeriodicLink& link : faces) nodes += link.nodes.size(), mesh_.periodic.push_back(std::move(link));
    for (PeriodicLink& link : mesh_.periodic) {
      std::ranges::sort(link.nodes);
      link.nodes.erase(std::unique(link.nodes.begin(), link.nodes.end()), link.nodes.end());
    }
    const std::size_t count = faces.empty() ? periodic_.lines.size() : faces.size();
    monitor_.message(Level::summary, "periodic: " + std::to_string(count) + (count == 1 ? " pair of " : " pairs of ") + (faces.empty() ? "lines, " : "faces, ") +
                                         std::to_string(nodes) + " pairs of vertices, " + short_number(worst_) + " apart at most");
  }

  const PeriodicTriangles& periodic_;
  Cad& cad_;
  CompositeResult& result_;
  SurfaceMesh& mesh_;
  Monitor& monitor_;
  std::map<std::pair<LineNodeOf, LineNodeOf>, Isometry> image_;  // {master, slave} nodes of lines
  std::map<int, FaceSearch> searches_;                                // by face
  double worst_ = 0;
};

}  // namespace

double share_sizes(const PeriodicTriangles& periodic, const SurfaceMesh& mesh, std::span<double> size) {
  const auto [smallest, largest] = std::ranges::minmax_element(size);
  if (size.empty() || *smallest == *largest) return 1;
  double least = 1;
  const auto lower = [&](std::int32_t v, double h, bool on_line) {
    if (on_line) least = std::min(least, h / size[v]);
    size[v] = std::min(size[v], h);
  };
  for (const TrianglePair& pair : periodic.faces) {
    std::vector<std::array<std::int32_t, 3>> triangles;
    const FaceMesh& slave = mesh.faces[pair.slave];
    for (const auto& t : slave.triangles) triangles.push_back({slave.vertex[t[0]], slave.vertex[t[1]], slave.vertex[t[2]]});
    const TriangleSearch search(mesh.vertices, triangles);
    for (const std::int32_t v : mesh.faces[pair.master].vertex) {
      const NearestOnMesh near = search.nearest(pair.map(mesh.vertices[v]));
      double h = 0;
      for (std::size_t k = 0; k < 3; ++k) h += near.weight[k] * size[triangles[near.triangle][k]];
      lower(v, h, false);
    }
  }
  for (const bool back : {false, true})  // to the masters, and to all slaves
    for (const TrianglePair& pair : periodic.lines) {
      const std::vector<std::int32_t>& from = mesh.curves[back ? pair.master : pair.slave].vertices;
      const std::vector<std::int32_t>& to = mesh.curves[back ? pair.slave : pair.master].vertices;
      const std::vector<double> there = shares_of(mesh, from), here = shares_of(mesh, to);
      for (std::size_t k = 0; k < to.size(); ++k) lower(to[k], size_on(there, from, size, here[k]), true);
    }
  return least;
}

void make_periodic(const PeriodicTriangles& periodic, Cad& cad, CompositeResult& result, Monitor& monitor) {
  if (!periodic.empty()) Maker(periodic, cad, result, monitor).run();
}

}  // namespace carreau
