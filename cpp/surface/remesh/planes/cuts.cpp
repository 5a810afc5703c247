// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "curve/unit_discretisation.h"
#include "predicates/clamped_int.h"
#include "support/infinity.h"
#include "surface/remesh/planes/borders.h"
#include "surface/remesh/planes/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::planes;

/// A place on the flat triangles.
struct CutPoint {
  Foot foot;
  Vec3 xyz;
};

/// The end of cuts: on a sharp line, whose vertex is known, or amid a region.
struct CutNode {
  std::int32_t vertex = -1;  ///< of the mesh to come; -1: not on a line
  CutPoint at;
  bool stays = false;
  std::vector<std::pair<std::size_t, bool>> cuts = {};  ///< that end here; true: they start
};

struct Cut {
  std::vector<std::int32_t> path;       ///< vertices of the atlas
  std::vector<std::int32_t> triangles;  ///< on the left of its edges
  std::int32_t left = -1, right = -1;
  std::size_t start = 0, end = 0;  ///< nodes
  std::vector<CutPoint> inner = {};
  bool exact = false, undivided = false;  ///< see ProjectedCharts
};

/// An edge between charts, as the triangle on its left runs.
struct CutEdge {
  std::int32_t from, to, triangle, left, right;
};

class CutTracer {
 public:
  CutTracer(const BorderInput& input, const LinePoints& points, Borders& borders, Monitor& monitor)
      : input_(input), atlas_(input.atlas), points_(points), borders_(borders), monitor_(monitor) {}

  void run() {
    collect();
    trace();
    for (Cut& cut : cuts_) begin(cut);
    for (int sweep = 0; sweep < sweeps; ++sweep) straighten();
    for (Cut& cut : cuts_)
      if (!cut.exact && !divide(cut)) cut.exact = true, keep_path(cut);
    for (int sweep = 0; sweep < last_sweeps; ++sweep) straighten();
    number();
  }

 private:
  void collect() {
    for (std::int32_t t = 0; t < atlas_.triangles(); ++t) {
      const Charts::Triangle& here = atlas_.at(t);
      const auto& chart = input_.charts.chart;
      for (int i = 0; i < 3; ++i)
        if (const std::int32_t u = here.beyond[i]; u >= 0 && chart[u] != chart[t])
          edges_.push_back({here.vertex[i], here.vertex[(i + 1) % 3], t, chart[t], chart[u]});
    }
    std::ranges::sort(edges_, {}, [](const CutEdge& e) { return std::array{e.from, e.to, e.triangle}; });
    used_.assign(edges_.size(), 0);
  }

  [[nodiscard]] std::span<const CutEdge> from(std::int32_t v) const {
    const auto first = std::ranges::lower_bound(edges_, v, {}, &CutEdge::from);
    const auto last = std::ranges::upper_bound(edges_, v, {}, &CutEdge::from);
    return {first, last};
  }
  [[nodiscard]] bool is_node(std::int32_t v) const { return points_.of(v).vertex >= 0 || from(v).size() != 2; }

  void use(const CutEdge& e) {
    used_[static_cast<std::size_t>(&e - edges_.data())] = 1;
    for (const CutEdge& back : from(e.to))
      if (back.to == e.from) used_[static_cast<std::size_t>(&back - edges_.data())] = 1;
  }

  // Traces cuts from node to node, then the closed cuts that are left.
  void trace() {
    for (const bool around : {false, true})
      for (std::size_t k = 0; k < edges_.size(); ++k)
        if (used_[k] == 0 && (around || is_node(edges_[k].from))) follow(edges_[k]);
  }

  void follow(const CutEdge& first) {
    Cut cut;
    cut.left = first.left, cut.right = first.right;
    cut.path.push_back(first.from);
    const CutEdge* e = &first;
    for (;;) {
      use(*e);
      cut.path.push_back(e->to), cut.triangles.push_back(e->triangle);
      if (e->to == first.from || is_node(e->to)) break;
      const auto next = from(e->to);
      e = next[0].to == e->from ? &next[1] : &next[0];
    }
    cut.start = node_at(cut.path.front(), cut.triangles.front());
    cut.end = node_at(cut.path.back(), cut.triangles.back());
    const char exact = std::max(input_.exact[cut.left], input_.exact[cut.right]);
    cut.exact = exact != 0, cut.undivided = exact == max_exact;
    for (const std::size_t end : {cut.start, cut.end})
      nodes_[end].stays = nodes_[end].stays || cut.exact || nodes_[end].vertex >= 0;
    nodes_[cut.start].cuts.emplace_back(cuts_.size(), true);
    nodes_[cut.end].cuts.emplace_back(cuts_.size(), false);
    cuts_.push_back(std::move(cut));
  }

  std::size_t node_at(std::int32_t v, std::int32_t triangle) {
    const auto [known, fresh] = node_of_.try_emplace(v, nodes_.size());
    if (!fresh) return known->second;
    const LinePoints::Point& on = points_.of(v);
    const Foot foot{triangle, uv_of(triangle, v)};
    nodes_.push_back({on.vertex, {foot, on.vertex >= 0 ? on.xyz : atlas_.xyz(v)}});
    return known->second;
  }

  [[nodiscard]] Vec2 uv_of(std::int32_t triangle, std::int32_t v) const {
    const auto& corners = atlas_.at(triangle).vertex;
    return atlas_.charts.uv(triangle, static_cast<int>(std::ranges::find(corners, v) - corners.begin()));
  }

  // Divides edges of the atlas that are longer than the sizes, except edges whose parts would cross others.
  void keep_path(Cut& cut) const {
    cut.inner.clear();
    for (std::size_t k = 0; k + 1 < cut.path.size(); ++k) {
      const std::int32_t v = cut.path[k], w = cut.path[k + 1], t = cut.triangles[k];
      const double length = norm(atlas_.xyz(w) - atlas_.xyz(v)), size = 0.5 * (input_.size[v] + input_.size[w]);
      const int parts = cut.undivided ? 1 : clamped_int(std::round(length / size), 1, std::numeric_limits<int>::max());
      for (int j = k == 0 ? 1 : 0; j < parts; ++j) {
        const double s = static_cast<double>(j) / parts;
        cut.inner.push_back({{t, lerp(uv_of(t, v), uv_of(t, w), s)}, lerp(atlas_.xyz(v), atlas_.xyz(w), s)});
      }
    }
  }

  // Points along the path, about an edge apart, two at least.
  void begin(Cut& cut) {
    if (cut.exact) return keep_path(cut);
    std::vector<double> arc{0}, h{input_.size[cut.path[0]]};
    for (std::size_t k = 1; k < cut.path.size(); ++k) {
      arc.push_back(arc.back() + norm(atlas_.xyz(cut.path[k]) - atlas_.xyz(cut.path[k - 1])));
      h.push_back(input_.size[cut.path[k]]);
    }
    const std::vector<double> to = split_by_sizes(arc, h, SizeLaw::linear, 3);
    std::size_t k = 0;
    for (std::size_t j = 1; j + 1 < to.size(); ++j) {
      while (k + 2 < arc.size() && arc[k + 1] < to[j]) ++k;
      const double s = std::clamp((to[j] - arc[k]) / (arc[k + 1] - arc[k]), 0.0, 1.0);
      const std::int32_t t = cut.triangles[k];
      cut.inner.push_back({{t, lerp(uv_of(t, cut.path[k]), uv_of(t, cut.path[k + 1]), s)},
                           lerp(atlas_.xyz(cut.path[k]), atlas_.xyz(cut.path[k + 1]), s)});
    }
  }

  [[nodiscard]] std::optional<CutPoint> near(const CutPoint& from, const Vec3& target) const {
    const auto foot = atlas_.charts.flat_foot(from.foot.triangle, target);
    if (!foot) return {};
    return CutPoint{*foot, atlas_.flat(*foot)};
  }

  // Cosine of the angle between the surface and the axes of both charts. A cut that slides over the end of a thin part,
  // where one chart does not show it, would cut the end off.
  [[nodiscard]] double min_shown(const Cut& cut, const CutPoint& p) const {
    const Vec3& normal = atlas_.normal[p.foot.triangle];
    return std::min(dot(normal, input_.charts.axis[cut.left]), dot(normal, input_.charts.axis[cut.right]));
  }

  void straighten() {
    monitor_.checkpoint();
    for (CutNode& node : nodes_) {
      if (node.stays) continue;
      Vec3 sum{0, 0, 0};
      for (const auto& [cut, starts] : node.cuts) sum += next_to(cuts_[cut], starts);
      double shown = infinity, still_shown = infinity;
      const auto at = near(node.at, sum / static_cast<double>(node.cuts.size()));
      for (const auto& [cut, starts] : node.cuts) {
        shown = std::min(shown, min_shown(cuts_[cut], node.at));
        if (at) still_shown = std::min(still_shown, min_shown(cuts_[cut], *at));
      }
      if (at && still_shown >= std::min(min_cosine, shown)) node.at = *at;
    }
    for (Cut& cut : cuts_)
      for (std::size_t k = 0; k < cut.inner.size() && !cut.exact; ++k) {
        const Vec3& before = k == 0 ? nodes_[cut.start].at.xyz : cut.inner[k - 1].xyz;
        const Vec3& after = k + 1 == cut.inner.size() ? nodes_[cut.end].at.xyz : cut.inner[k + 1].xyz;
        if (const auto at = near(cut.inner[k], (before + after) / 2);
            at && min_shown(cut, *at) >= std::min(min_cosine, min_shown(cut, cut.inner[k])))
          cut.inner[k] = *at;
      }
  }
  [[nodiscard]] Vec3 next_to(const Cut& cut, bool start) const {
    if (cut.inner.empty()) return nodes_[start ? cut.end : cut.start].at.xyz;
    return start ? cut.inner.front().xyz : cut.inner.back().xyz;
  }

  // Divides the straightened cut by the sizes, into edges of equal metric length.
  bool divide(Cut& cut) {
    std::vector<const CutPoint*> points{&nodes_[cut.start].at};
    for (const CutPoint& p : cut.inner) points.push_back(&p);
    points.push_back(&nodes_[cut.end].at);
    std::vector<double> arc{0}, h{atlas_.charts.size(points.front()->foot)};
    for (std::size_t k = 1; k < points.size(); ++k) {
      const double way = norm(points[k]->xyz - points[k - 1]->xyz);
      if (!(way > 0)) return false;
      arc.push_back(arc.back() + way);
      h.push_back(atlas_.charts.size(points[k]->foot));
    }
    std::vector<double> to = split_by_sizes(arc, h, SizeLaw::linear, is_loop(cut) ? 3 : 1);
    if (to.size() == 2 && !lone_.insert(ends_of(cut)).second) to = split_by_sizes(arc, h, SizeLaw::linear, 2);
    std::vector<CutPoint> inner;
    std::size_t k = 0;
    for (std::size_t j = 1; j + 1 < to.size(); ++j) {
      while (k + 2 < arc.size() && arc[k + 1] < to[j]) ++k;
      const double s = std::clamp((to[j] - arc[k]) / (arc[k + 1] - arc[k]), 0.0, 1.0);
      const std::size_t nearest = std::clamp<std::size_t>(s < 0.5 ? k : k + 1, 1, points.size() - 2);
      const auto at = near(*points[nearest], lerp(points[k]->xyz, points[k + 1]->xyz, s));
      if (!at) return false;
      inner.push_back(*at);
    }
    cut.inner = std::move(inner);
    return true;
  }
  [[nodiscard]] bool is_loop(const Cut& cut) const {
    const std::int32_t v = nodes_[cut.start].vertex;
    return cut.start == cut.end || (v >= 0 && v == nodes_[cut.end].vertex);
  }
  [[nodiscard]] std::array<std::size_t, 2> ends_of(const Cut& cut) const {
    return {std::min(cut.start, cut.end), std::max(cut.start, cut.end)};
  }

  void number() {
    const auto add = [&](const CutPoint& p) {
      borders_.added.push_back(atlas_.charts.evaluate(input_.cad, p.foot));
      return static_cast<std::int32_t>(atlas_.mesh.vertices.size() + borders_.added.size()) - 1;
    };
    for (CutNode& node : nodes_)
      if (node.vertex < 0) node.vertex = add(node.at);
    for (const auto& [v, node] : node_of_) borders_.number[v] = nodes_[node].vertex;
    for (const Cut& cut : cuts_) {
      BorderChain& chain = borders_.chains.emplace_back();
      chain.left = cut.left, chain.right = cut.right;
      chain.vertices.push_back(nodes_[cut.start].vertex);
      for (const CutPoint& p : cut.inner) chain.vertices.push_back(add(p));
      for (std::size_t k = 1; cut.undivided && k + 1 < cut.path.size(); ++k)
        borders_.number[cut.path[k]] = chain.vertices[k];
      chain.vertices.push_back(nodes_[cut.end].vertex);
    }
  }

  const BorderInput& input_;
  const FlatAtlas& atlas_;
  const LinePoints& points_;
  Borders& borders_;
  Monitor& monitor_;
  std::vector<CutEdge> edges_;
  std::vector<char> used_;
  std::vector<CutNode> nodes_;
  std::map<std::int32_t, std::size_t> node_of_;  // by vertex of the atlas
  std::vector<Cut> cuts_;
  std::set<std::array<std::size_t, 2>> lone_;  // cuts of one edge
};

}  // namespace

void trace_cuts(const BorderInput& input, const LinePoints& points, Borders& borders, Monitor& monitor) {
  CutTracer(input, points, borders, monitor).run();
}

}  // namespace carreau
