// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/grid/borders.h"

#include <algorithm>
#include <set>

#include "model/near_points.h"
#include "support/error.h"

namespace carreau::grid {

namespace {

using Key = std::pair<int, int>;
/// The faces that an edge bounds.
using Signature = std::vector<int>;

class BorderFinder {
 public:
  BorderFinder(std::vector<Block>& blocks, const std::vector<Cells>& cells, double tolerance)
      : blocks_(blocks), cells_(cells), tolerance_(tolerance) {}

  Borders run() {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      for (std::size_t r = 0; r < cells_[b].regions.size(); ++r)
        borders_.faces.push_back({static_cast<int>(b), static_cast<int>(r)});
    merge_nodes();
    collect_edges();
    check_overlap();
    find_breaks();
    cut_loops();
    return std::move(borders_);
  }

 private:
  [[nodiscard]] const Block& block_of(int face) const {
    return blocks_[static_cast<std::size_t>(borders_.faces[static_cast<std::size_t>(face)].block)];
  }
  [[nodiscard]] const Region& region_of(int face) const {
    const FaceRegion& at = borders_.faces[static_cast<std::size_t>(face)];
    return cells_[static_cast<std::size_t>(at.block)].regions[static_cast<std::size_t>(at.region)];
  }
  [[nodiscard]] int point(int face, const BorderEdge::NodeAt& at) const {
    const int block = borders_.faces[static_cast<std::size_t>(face)].block;
    return borders_.point(block, block_of(face), at);
  }
  [[nodiscard]] Key key(int face, const BorderEdge& edge) const {
    const int a = point(face, edge.start()), b = point(face, edge.end());
    return {std::min(a, b), std::max(a, b)};
  }

  template <typename Visit>
  void for_edges(Visit&& visit) const {
    for (int face = 0; face < static_cast<int>(borders_.faces.size()); ++face)
      for (const std::vector<BorderEdge>& loop : region_of(face).loops)
        for (const BorderEdge& edge : loop) visit(face, edge);
  }

  void merge_nodes() {
    std::vector<std::pair<int, std::size_t>> nodes;  // block and node, each once
    for (const Block& block : blocks_) borders_.point_of.emplace_back(block.nodes.size(), 0);
    for_edges([&](int face, const BorderEdge& edge) {
      const int block = borders_.faces[static_cast<std::size_t>(face)].block;
      const BorderEdge::NodeAt at = edge.start();
      nodes.emplace_back(block, block_of(face).index(at.i, at.j));
    });
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    std::vector<Vec3> places;
    for (const auto& [block, node] : nodes) places.push_back(blocks_[static_cast<std::size_t>(block)].nodes[node]);
    UnionFind same(places.size());
    merge_near_points(places, tolerance_, same);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto block = static_cast<std::size_t>(nodes[k].first);
      const std::size_t first = same.find(k);
      borders_.point_of[block][nodes[k].second] = static_cast<int>(first) + 1;
      blocks_[block].nodes[nodes[k].second] = places[first];
    }
  }

  void collect_edges() {
    for_edges([&](int face, const BorderEdge& edge) {
      const Key ends = key(face, edge);
      if (ends.first != ends.second) borders_.edges[ends].push_back({face, edge});
    });
  }

  /// The place of a node of the cell that is not on the edge, behind the end with this point.
  [[nodiscard]] const Vec3& inner(const EdgeUse& use, int end_point) const {
    const bool at_start = point(use.face, use.edge.start()) == end_point;
    const BorderEdge::NodeAt at = at_start ? use.edge.inner_start() : use.edge.inner_end();
    return block_of(use.face).node(at.i, at.j);
  }

  void check_overlap() const {
    for (const auto& [ends, uses] : borders_.edges)
      for (std::size_t k = 1; k < uses.size(); ++k)
        for (std::size_t l = 0; l < k; ++l) {
          if (norm(inner(uses[k], ends.first) - inner(uses[l], ends.first)) > tolerance_ ||
              norm(inner(uses[k], ends.second) - inner(uses[l], ends.second)) > tolerance_)
            continue;
          if (is_one_point(uses[k], ends)) continue;
          throw InvalidModel(place(uses[l]) + " and " + place(uses[k]) + " are the same: blocks overlap");
        }
  }

  /// Returns whether the cell is a triangle on this edge: two cells may have the same third corner, and be two sides of
  /// a fin.
  [[nodiscard]] bool is_one_point(const EdgeUse& use, const Key& ends) const {
    return norm(inner(use, ends.first) - inner(use, ends.second)) <= tolerance_;
  }

  [[nodiscard]] std::string place(const EdgeUse& use) const {
    return Block::place(static_cast<std::size_t>(borders_.faces[static_cast<std::size_t>(use.face)].block), use.edge.i,
                        use.edge.j);
  }

  [[nodiscard]] Signature signature(const std::vector<EdgeUse>& uses) const {
    Signature faces;
    for (const EdgeUse& use : uses) faces.push_back(use.face);
    std::sort(faces.begin(), faces.end());
    return faces;
  }

  /// Curves end where other than two edges meet, and where the faces at their sides change. They also end where a
  /// border turns in (u, v), and at points that are a whole edge of some face.
  void find_breaks() {
    std::map<int, std::vector<const std::vector<EdgeUse>*>> around;
    for (const auto& [ends, uses] : borders_.edges) around[ends.first].push_back(&uses), around[ends.second].push_back(&uses);
    for (const auto& [point, edges] : around)
      if (edges.size() != 2 || signature(*edges[0]) != signature(*edges[1])) breaks_.insert(point);
    for (int face = 0; face < static_cast<int>(borders_.faces.size()); ++face)
      for (const std::vector<BorderEdge>& loop : region_of(face).loops)
        for (std::size_t k = 0; k < loop.size(); ++k) {
          const BorderEdge& edge = loop[k];
          const Key ends = key(face, edge);
          if (ends.first == ends.second || loop[(k + 1) % loop.size()].side != edge.side)
            breaks_.insert(point(face, edge.end()));
        }
  }

  [[nodiscard]] bool is_point(int face, const BorderEdge& edge) const {
    const Key ends = key(face, edge);
    return ends.first == ends.second;
  }

  [[nodiscard]] bool ends_between(int face, const BorderEdge& a, const BorderEdge& b) const {
    if (a.side == b.side && is_point(face, a) && is_point(face, b)) return false;
    return a.side != b.side || breaks_.contains(point(face, a.end()));
  }

  void cut_loops() {
    std::map<Key, int> curve_of;  // by the smallest edge of a chain
    borders_.chains.resize(borders_.faces.size());
    for (int face = 0; face < static_cast<int>(borders_.faces.size()); ++face)
      for (const std::vector<BorderEdge>& loop : region_of(face).loops) {
        const std::size_t n = loop.size();
        std::size_t first = 0;  // a loop turns somewhere
        while (!ends_between(face, loop[(first + n - 1) % n], loop[first])) ++first;
        for (std::size_t k = 0; k < n;) {
          Chain chain;
          do chain.edges.push_back(loop[(first + k++) % n]);
          while (k < n && !ends_between(face, chain.edges.back(), loop[(first + k) % n]));
          add_chain(face, std::move(chain), curve_of);
        }
      }
  }

  void add_chain(int face, Chain chain, std::map<Key, int>& curve_of) {
    chain.start = point(face, chain.edges.front().start()), chain.end = point(face, chain.edges.back().end());
    chain.point = is_point(face, chain.edges.front());
    if (chain.point) {
      chain.curve = ++last_curve_;
    } else {
      Key least = key(face, chain.edges.front());
      for (const BorderEdge& edge : chain.edges) least = std::min(least, key(face, edge));
      const auto [found, is_new] = curve_of.try_emplace(least, last_curve_ + 1);
      if (is_new) ++last_curve_;
      chain.curve = found->second;
    }
    borders_.chains[static_cast<std::size_t>(face)].push_back(std::move(chain));
  }

  std::vector<Block>& blocks_;
  const std::vector<Cells>& cells_;
  double tolerance_;
  Borders borders_;
  std::set<int> breaks_;
  int last_curve_ = 0;
};

}  // namespace

Borders find_borders(std::vector<Block>& blocks, const std::vector<Cells>& cells, double tolerance) {
  return BorderFinder(blocks, cells, tolerance).run();
}

}  // namespace carreau::grid
