// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/refinement.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "geometry/discrete/triangulation.h"
#include "mesh/periodic_masters.h"
#include "model/nodes_by_place.h"
#include "support/error.h"
#include "support/infinity.h"
#include "support/shares.h"

namespace carreau::discrete {

namespace {

std::uint64_t key_of(std::int32_t v, std::int32_t w) noexcept {
  const Edge e = edge_of(v, w);
  return static_cast<std::uint64_t>(e[0]) << 32 | static_cast<std::uint64_t>(e[1]);
}

bool is_of_itself(const PeriodicLink& link) { return link.dimension == 1 && link.master == link.slave; }

/// Images of vertices under the map of each link. Links of a curve with itself have the first vertices of orbits: their images are
/// found by places.
class Images {
 public:
  Images(const std::vector<PeriodicLink>& links, const RefinedMesh& mesh) : links_(links), image_(links.size()) {
    for (std::size_t i = 0; i < links.size(); ++i) {
      for (const auto& [slave, master] : links[i].nodes) image_[i].emplace(master, slave);
      if (is_of_itself(links[i])) find_by_place(i, mesh);
    }
  }

  [[nodiscard]] std::int32_t of(std::size_t link, std::int32_t v) const {
    const auto found = image_[link].find(v);
    return found == image_[link].end() ? -1 : found->second;
  }
  void add(std::size_t link, std::int32_t v, std::int32_t image) { image_[link].emplace(v, image); }
  [[nodiscard]] NodeImages all(std::size_t link) const {
    NodeImages list;
    for (const auto& [v, w] : image_[link]) list.push_back({v, w});
    return list;
  }

 private:
  void find_by_place(std::size_t i, const RefinedMesh& mesh) {
    std::set<std::int32_t> nodes;
    for (const PeriodicLink& link : links_)
      if (is_of_itself(link) && link.slave == links_[i].slave)
        for (const auto& pair : link.nodes) nodes.insert(pair.begin(), pair.end());
    double shortest = infinity;
    const NodesByPlace::Positions position = [&](std::int32_t v) { return mesh.vertices[index(v)]; };
    for (const auto& c : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (const std::int32_t v = c[k], w = c[(k + 1) % 3]; nodes.contains(v) && nodes.contains(w)) shortest = std::min(shortest, norm(position(v) - position(w)));
    if (shortest == infinity) return;
    const std::vector<std::int32_t> list(nodes.begin(), nodes.end());
    const NodesByPlace places(list, position, static_cast<std::int32_t>(mesh.vertices.size()), shares::small * shortest);
    for (const std::int32_t v : list)
      places.for_near(links_[i].map(position(v)), v, [&](std::int32_t w) { image_[i].emplace(v, w); });
  }

  const std::vector<PeriodicLink>& links_;
  std::vector<std::map<std::int32_t, std::int32_t>> image_;  // by link
};

class Refiner {
 public:
  Refiner(const DiscreteSurface& surface, const RefinementWish& wish, const RefinementLimits& limits, Monitor& monitor, std::vector<PeriodicLink> periodic)
      : surface_(surface), wish_(wish), limits_(limits), monitor_(monitor), mesh_(unrefined(surface)), links_(std::move(periodic)), images_(links_, mesh_) {}

  RefinedMesh run() {
    for (int depth = 0;; ++depth) {
      monitor_.checkpoint();
      middle_.clear();
      mark();
      if (middle_.empty()) break;
      if (depth == limits_.depth) {
        mesh_.complete = false;
        break;
      }
      do {
        if (wish_.triangle) close();
      } while (follow());
      if (static_cast<std::int64_t>(mesh_.triangles.size() + 2 * middle_.size()) > limits_.triangles)
        throw LimitError("the refined mesh has more than " + std::to_string(limits_.triangles) + " triangles");
      cut();
    }
    keep_pairs();
    return std::move(mesh_);
  }

 private:
  static constexpr std::int32_t wanted = -1;

  template <typename Use>
  void for_images(const Use& use) const {
    for (std::size_t i = 0; i < links_.size(); ++i)
      for (const auto& c : mesh_.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
          const std::int32_t a = images_.of(i, c[k]), b = a < 0 ? -1 : images_.of(i, c[(k + 1) % 3]);
          if (b >= 0) use(i, c[k], c[(k + 1) % 3], a, b);
        }
  }

  // Edges are cut on both sides of a pair.
  bool follow() {
    if (links_.empty()) return false;
    std::unordered_set<std::uint64_t> edges;  // never iterated
    for (const auto& c : mesh_.triangles)
      for (std::size_t k = 0; k < 3; ++k) edges.insert(key_of(c[k], c[(k + 1) % 3]));
    bool more = false;
    for_images([&](std::size_t, std::int32_t v, std::int32_t w, std::int32_t a, std::int32_t b) {
      const std::uint64_t here = key_of(v, w), there = key_of(a, b);
      if (!edges.contains(there) || middle_.contains(here) == middle_.contains(there)) return;
      middle_.emplace(here, wanted), middle_.emplace(there, wanted);
      more = true;
    });
    return more;
  }

  /// An edge that is cut on both sides of a pair.
  struct CutPair {
    std::size_t link;
    std::uint64_t master, slave;
  };
  [[nodiscard]] std::vector<CutPair> cut_pairs() const {
    std::vector<CutPair> pairs;
    for_images([&](std::size_t i, std::int32_t v, std::int32_t w, std::int32_t a, std::int32_t b) {
      if (const CutPair pair{i, key_of(v, w), key_of(a, b)}; middle_.contains(pair.master) && middle_.contains(pair.slave)) pairs.push_back(pair);
    });
    return pairs;
  }

  // First on curves that are their own images, then in the order of the links.
  void place_images(const std::vector<CutPair>& pairs) {
    std::set<std::int32_t> placed;
    const auto place = [&](std::size_t link, std::int32_t slave, std::int32_t master) {
      if (slave != master && placed.insert(slave).second) mesh_.vertices[index(slave)] = links_[link].map(mesh_.vertices[index(master)]);
    };
    std::map<int, std::vector<std::pair<std::size_t, NodeImages>>> of_itself;  // by curve
    for (const auto& [link, master, slave] : pairs) {
      const std::int32_t v = middle_.at(master), w = middle_.at(slave);
      images_.add(link, v, w);
      if (!is_of_itself(links_[link])) continue;
      auto& maps = of_itself[links_[link].slave];
      if (maps.empty() || maps.back().first != link) maps.push_back({link, {}});
      maps.back().second.push_back({v, w});
    }
    for (const auto& [curve, maps] : of_itself) {
      std::vector<NodeImages> images;
      for (const auto& [link, nodes] : maps) images.push_back(nodes);
      const std::vector<NodeImages> orbits = pairs_of_orbits(images);
      for (std::size_t m = 0; m < maps.size(); ++m)
        for (const auto& [slave, master] : orbits[m]) place(maps[m].first, slave, master);
    }
    for (const auto& [link, master, slave] : pairs)
      if (!is_of_itself(links_[link])) place(link, middle_.at(slave), middle_.at(master));
  }

  void keep_pairs() {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      PeriodicLink& link = mesh_.periodic.emplace_back(links_[i]);
      link.nodes.clear();
      for (const auto& [v, w] : images_.all(i)) link.nodes.push_back({w, v});
      std::ranges::sort(link.nodes);
    }
  }

  void mark() {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& c = mesh_.triangles[t];
      const bool all = wish_.triangle && wish_.triangle(mesh_, t);
      for (std::size_t i = 0; i < 3; ++i)
        if (const std::int32_t v = c[i], w = c[(i + 1) % 3];
            all || (wish_.edge && wish_.edge(mesh_, std::min(v, w), std::max(v, w))))
          middle_.emplace(key_of(v, w), wanted);
    }
  }

  [[nodiscard]] int halved(const std::array<std::int32_t, 3>& c) const {
    int n = 0;
    for (std::size_t i = 0; i < 3; ++i) n += middle_.contains(key_of(c[i], c[(i + 1) % 3])) ? 1 : 0;
    return n;
  }

  // A triangle with two halves needs the third one halved, and so on.
  void close() {
    for (bool more = true; more;) {
      more = false;
      for (const auto& c : mesh_.triangles)
        if (halved(c) == 2)
          for (std::size_t i = 0; i < 3; ++i)
            more = middle_.emplace(key_of(c[i], c[(i + 1) % 3]), wanted).second || more;
    }
  }

  std::int32_t middle(std::size_t t, std::size_t i) {
    const auto& c = mesh_.triangles[t];
    std::int32_t& m = middle_.at(key_of(c[i], c[(i + 1) % 3]));
    if (m == wanted) {
      m = static_cast<std::int32_t>(mesh_.vertices.size());
      mesh_.vertices.push_back(surface_.at(mesh_.parent[t], middle_uv(t, i), want_position).s);
    }
    return m;
  }
  [[nodiscard]] Vec2 middle_uv(std::size_t t, std::size_t i) const {
    return 0.5 * (mesh_.uv[t][i] + mesh_.uv[t][(i + 1) % 3]);
  }

  void cut() {
    const std::vector<CutPair> pairs = cut_pairs();
    RefinedMesh next;
    next.triangles.reserve(mesh_.triangles.size() + 2 * middle_.size());
    const auto add = [&](std::size_t t, const std::array<std::int32_t, 3>& c, const std::array<Vec2, 3>& uv) {
      next.triangles.push_back(c), next.uv.push_back(uv), next.parent.push_back(mesh_.parent[t]);
    };
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto c = mesh_.triangles[t];
      const auto uv = mesh_.uv[t];
      const int n = halved(c);
      if (n == 0) {
        add(t, c, uv);
      } else if (n == 1) {
        std::size_t i = 0;
        while (!middle_.contains(key_of(c[i], c[(i + 1) % 3]))) ++i;
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const std::int32_t m = middle(t, i);
        add(t, {c[i], m, c[k]}, {uv[i], middle_uv(t, i), uv[k]});
        add(t, {m, c[j], c[k]}, {middle_uv(t, i), uv[j], uv[k]});
      } else if (n == 2) {
        std::size_t k = 0;  // the corner between the halved sides
        while (middle_.contains(key_of(c[(k + 1) % 3], c[(k + 2) % 3]))) ++k;
        const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
        const std::int32_t ma = middle(t, k), mb = middle(t, b);
        const Vec2 pa = middle_uv(t, k), pb = middle_uv(t, b);
        add(t, {c[k], ma, mb}, {uv[k], pa, pb});
        // The shorter diagonal of the remaining quadrilateral.
        const auto at = [&](std::int32_t v) -> const Vec3& { return mesh_.vertices[index(v)]; };
        if (norm(at(c[a]) - at(mb)) <= norm(at(c[b]) - at(ma))) {
          add(t, {ma, c[a], mb}, {pa, uv[a], pb});
          add(t, {mb, c[a], c[b]}, {pb, uv[a], uv[b]});
        } else {
          add(t, {ma, c[a], c[b]}, {pa, uv[a], uv[b]});
          add(t, {mb, ma, c[b]}, {pb, pa, uv[b]});
        }
      } else {
        const std::array<std::int32_t, 3> m{middle(t, 0), middle(t, 1), middle(t, 2)};
        const std::array<Vec2, 3> p{middle_uv(t, 0), middle_uv(t, 1), middle_uv(t, 2)};
        add(t, m, p);
        for (std::size_t i = 0; i < 3; ++i) add(t, {c[i], m[i], m[(i + 2) % 3]}, {uv[i], p[i], p[(i + 2) % 3]});
      }
    }
    mesh_.triangles = std::move(next.triangles), mesh_.uv = std::move(next.uv), mesh_.parent = std::move(next.parent);
    for (auto& line : mesh_.lines) {
      std::vector<std::int32_t> finer{line.front()};
      for (std::size_t k = 1; k < line.size(); ++k) {
        if (const auto found = middle_.find(key_of(line[k - 1], line[k])); found != middle_.end())
          finer.push_back(found->second);
        finer.push_back(line[k]);
      }
      line = std::move(finer);
    }
    place_images(pairs);
  }

  const DiscreteSurface& surface_;
  const RefinementWish& wish_;
  const RefinementLimits& limits_;
  Monitor& monitor_;
  RefinedMesh mesh_;
  const std::vector<PeriodicLink> links_;
  Images images_;
  std::unordered_map<std::uint64_t, std::int32_t> middle_;  // of halved edges; never iterated
};

/// Lines and corners of a refined mesh have references of their own: their pairs follow from the vertices.
class PairsOfLines {
 public:
  PairsOfLines(const RefinedMesh& mesh, const std::vector<std::int32_t>& corner_ref) : mesh_(mesh), corner_ref_(corner_ref) {
    for (std::size_t l = 0; l < mesh.lines.size(); ++l)
      for (std::size_t k = 0; k < mesh.lines[l].size(); ++k) {
        if (k > 0) line_of_.emplace(key_of(mesh.lines[l][k - 1], mesh.lines[l][k]), l);
        lines_at_[mesh.lines[l][k]].insert(l);
      }
  }

  std::vector<PeriodicLink> run() {
    for (const PeriodicLink& link : mesh_.periodic)
      if (!is_of_itself(link)) add(link);
    for (std::size_t i = 0; i < mesh_.periodic.size(); ++i)
      if (is_of_itself(mesh_.periodic[i])) add_itself(i);
    std::ranges::stable_sort(found_, {}, &PeriodicLink::dimension);
    return std::move(found_);
  }

 private:
  void add(const PeriodicLink& link) {
    std::map<std::int32_t, std::int32_t> image;
    for (const auto& [w, v] : link.nodes) image.emplace(v, w);
    for (const auto& [v, w] : image) {
      const std::int32_t from = corner_ref_[index(v)], to = corner_ref_[index(w)];
      if (from != 0 && to != 0 && from != to && get_master(corners_, to, from))
        found_.push_back({.dimension = 0, .master = from, .slave = to, .map = link.map, .nodes = {{w, v}}});
    }
    for (std::size_t l = 0; l < mesh_.lines.size(); ++l) {
      const std::vector<std::int32_t>& line = mesh_.lines[l];
      PeriodicLink made{.dimension = 1, .master = static_cast<int>(l) + 1, .slave = 0, .map = link.map};
      bool all = true;
      for (std::size_t k = 0; k < line.size() && all; ++k) {
        const auto here = image.find(line[k]);
        all = here != image.end();
        if (!all) break;
        made.nodes.push_back({here->second, line[k]});
        if (k == 0) continue;
        const auto there = line_of_.find(key_of(made.nodes[k - 1][0], here->second));
        all = there != line_of_.end() && there->second != l && (k == 1 || made.slave == static_cast<int>(there->second) + 1);
        if (all) made.slave = static_cast<int>(there->second) + 1;
      }
      if (!all || made.slave == 0 || !get_master(lines_, made.slave, made.master)) continue;
      std::ranges::sort(made.nodes);
      made.nodes.erase(std::unique(made.nodes.begin(), made.nodes.end()), made.nodes.end());
      found_.push_back(std::move(made));
    }
  }

  // Returns whether the slave gets the master: it has none, and the chain of masters above does not return to it.
  static bool get_master(std::map<int, int>& masters, int slave, int master) {
    int above = master;
    for (auto next = masters.find(above); next != masters.end(); next = masters.find(above)) above = next->second;
    return above != slave && masters.emplace(slave, master).second;
  }

  void add_itself(std::size_t first) {
    const int curve = mesh_.periodic[first].slave;
    if (!themselves_.insert(curve).second) return;
    std::vector<std::size_t> links;
    std::vector<NodeImages> images;
    for (std::size_t i = first; i < mesh_.periodic.size(); ++i) {
      const PeriodicLink& link = mesh_.periodic[i];
      if (!is_of_itself(link) || link.slave != curve) continue;
      links.push_back(i);
      NodeImages& all = images.emplace_back();
      for (const auto& [w, v] : link.nodes) all.push_back({v, w});
    }
    std::vector<NodeImages> pairs = pairs_of_orbits(images);
    for (std::size_t m = 0; m < links.size(); ++m) {
      std::map<std::size_t, NodeImages> by_line;  // one curve may be several lines
      for (const auto& pair : pairs[m])
        if (const std::size_t l = line_with(pair); l < mesh_.lines.size()) by_line[l].push_back(pair);
      for (auto& [l, nodes] : by_line) {
        std::ranges::sort(nodes);
        found_.push_back({.dimension = 1, .master = static_cast<int>(l) + 1, .slave = static_cast<int>(l) + 1, .map = mesh_.periodic[links[m]].map, .nodes = nodes});
      }
    }
  }
  [[nodiscard]] std::size_t line_with(const std::array<std::int32_t, 2>& pair) const {
    const auto first = lines_at_.find(pair[0]), second = lines_at_.find(pair[1]);
    if (first == lines_at_.end() || second == lines_at_.end()) return mesh_.lines.size();
    const auto common = std::ranges::find_if(first->second, [&](std::size_t l) { return second->second.contains(l); });
    return common == first->second.end() ? mesh_.lines.size() : *common;
  }

  const RefinedMesh& mesh_;
  const std::vector<std::int32_t>& corner_ref_;
  std::unordered_map<std::uint64_t, std::size_t> line_of_;  // by edge; never iterated
  std::map<std::int32_t, std::set<std::size_t>> lines_at_;  // by vertex
  std::map<int, int> lines_, corners_;  // masters by slave
  std::set<int> themselves_;
  std::vector<PeriodicLink> found_;
};

}  // namespace

RefinedMesh unrefined(const DiscreteSurface& surface) {
  RefinedMesh mesh;
  mesh.vertices = surface.mesh().vertices;
  mesh.triangles = surface.mesh().triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) mesh.parent.push_back(static_cast<std::int32_t>(t));
  mesh.uv.assign(mesh.triangles.size(), {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}});
  for (const Line& line : surface.lines().lines) mesh.lines.push_back(line.vertices);
  return mesh;
}

RefinedMesh refine(const DiscreteSurface& surface, const RefinementWish& wish, const RefinementLimits& limits,
                   Monitor& monitor, std::vector<PeriodicLink> periodic) {
  return Refiner(surface, wish, limits, monitor, std::move(periodic)).run();
}

RefinementWish wish_of_angle(const DiscreteSurface& surface, double angle) {
  constexpr double right = 90;
  if (!(angle > 0 && angle <= right))
    throw InvalidArgument("the angle of refinement must lie above 0 and not above 90 degrees");
  const double cosine = std::cos(angle * std::numbers::pi / (2 * right));
  RefinementWish wish;
  wish.triangle = [&surface, cosine](const RefinedMesh& mesh, std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 n =
        cross(mesh.vertices[index(b)] - mesh.vertices[index(a)], mesh.vertices[index(c)] - mesh.vertices[index(a)]);
    const double length = norm(n);
    return std::ranges::any_of(mesh.uv[t], [&](const Vec2& uv) {
      const SurfaceJet jet = surface.at(mesh.parent[t], uv, want_first);
      const Vec3 m = cross(jet.su, jet.sv);
      return dot(m, n) < cosine * norm(m) * length;
    });
  };
  return wish;
}

std::vector<std::int32_t> face_refs(const DiscreteSurface& surface) {
  if (!surface.faces().empty()) return surface.faces();
  const std::vector<std::int32_t>& given = surface.mesh().refs;
  const bool several = std::ranges::any_of(given, [&](std::int32_t ref) { return ref != given.front(); });
  const std::int32_t shift = several ? std::max(0, 1 - *std::ranges::min_element(given)) : 0;
  std::vector<std::int32_t> refs;
  for (std::size_t t = 0; t < given.size(); ++t)
    refs.push_back(several ? given[t] + shift : surface.lines().region[t] + 1);
  return refs;
}

FlatMesh flat_mesh(const DiscreteSurface& surface, const RefinedMesh& mesh) {
  FlatMesh flat;
  flat.vertices = mesh.vertices;
  flat.triangles = mesh.triangles;
  const std::vector<std::int32_t> refs = face_refs(surface);
  for (const std::int32_t parent : mesh.parent) flat.triangle_refs.push_back(refs[index(parent)]);
  flat.vertex_refs.assign(mesh.vertices.size(), 0);
  std::int32_t number = 0;
  for (const std::int32_t v : surface.lines().corners) flat.vertex_refs[index(v)] = ++number;
  number = 0;
  for (const auto& line : mesh.lines) {
    ++number;
    for (std::size_t k = 1; k < line.size(); ++k) {
      flat.edges.push_back({line[k - 1], line[k]});
      flat.edge_refs.push_back(number);
    }
  }
  if (mesh.periodic.empty()) return flat;
  flat.periodic = PairsOfLines(mesh, flat.vertex_refs).run();
  std::ranges::copy_if(mesh.periodic, std::back_inserter(flat.periodic), [](const PeriodicLink& link) { return link.dimension == 2; });
  add_periodic_masters(flat);
  return flat;
}

}  // namespace carreau::discrete
