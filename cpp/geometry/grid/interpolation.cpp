// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/grid/interpolation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include "geometry/grid/differences.h"
#include "geometry/grid/shared_derivatives.h"
#include "geometry/grid/thresholds.h"

namespace carreau::grid {

namespace {

/// A line of nodes: node k is first + k * step.
struct Line {
  std::size_t first, step, count;
};

std::vector<Line> lines_of(const Block& block, bool along_u) {
  const auto columns = static_cast<std::size_t>(block.columns), rows = static_cast<std::size_t>(block.rows);
  std::vector<Line> lines;
  for (std::size_t k = 0; k < (along_u ? rows : columns); ++k)
    lines.push_back(along_u ? Line{k * columns, 1, columns} : Line{k, columns, rows});
  return lines;
}

/// Derivatives that nodes must have; empty: none.
using Prescribed = std::vector<std::optional<Vec3>>;

/// Derivatives of value(node) along u or v at all nodes, by parabolas or splines.
template <typename Value>
std::vector<Vec3> differentiate(const Block& block, const Knots& knots, const Closed& closed, bool along_u,
                                Value&& value, bool splines, const Prescribed& prescribed = {}) {
  const std::vector<double>& x = along_u ? knots.u : knots.v;
  std::vector<Vec3> out(block.nodes.size());
  std::vector<Sample> samples(x.size());
  std::vector<char> there(x.size());
  Prescribed given(prescribed.empty() ? 0 : x.size());
  for (const Line& line : lines_of(block, along_u)) {
    for (std::size_t k = 0; k < line.count; ++k) {
      const std::size_t node = line.first + k * line.step;
      samples[k] = {x[k], value(node)};
      there[k] = is_finite(block.nodes[node]) ? 1 : 0;
    }
    for (std::size_t k = 0; k < given.size(); ++k) given[k] = prescribed[line.first + k * line.step];
    const bool around = along_u ? closed.columns : closed.rows;
    const std::vector<Vec3> d = splines ? spline_derivatives(samples, there, around, given) : line_derivatives(samples, there, around);
    for (std::size_t k = 0; k < line.count; ++k) out[line.first + k * line.step] = d[k];
  }
  return out;
}

/// +1 when the region lies on the side of growing parameters of an edge, else -1.
int inward(const BorderEdge& edge) { return edge.side == 0 || edge.side == 3 ? 1 : -1; }

class Interpolator {
 public:
  Interpolator(const std::vector<Block>& blocks, const Borders& borders, const std::vector<Knots>& knots,
               const std::vector<Closed>& closed, const Options& options)
      : blocks_(blocks), borders_(borders), knots_(knots), closed_(closed), options_(options) {}

  std::vector<CoonsSurface> run() {
    for (std::size_t b = 0; b < blocks_.size(); ++b) add_surface(b);
    share_along_edges();
    if (options_.join_angle > 0) join_chains();
    if (options_.splines) fit_splines();
    shared_.for_values([&](const SharedDerivatives::Slot& slot, const Vec3& value) {
      Node& node = surfaces_[static_cast<std::size_t>(slot.block)].nodes[slot.node];
      (slot.along_u ? node.su : node.sv) = value;
    });
    if (options_.cross_derivatives) add_cross_derivatives();
    return std::move(surfaces_);
  }

  [[nodiscard]] std::size_t joined() const { return joined_ / 2; }

 private:
  struct Place {
    std::size_t block, node;
  };

  [[nodiscard]] std::size_t block_of(const EdgeUse& use) const {
    return static_cast<std::size_t>(borders_.faces[static_cast<std::size_t>(use.face)].block);
  }
  [[nodiscard]] Place place(const EdgeUse& use, const BorderEdge::NodeAt& at) const {
    const std::size_t block = block_of(use);
    return {block, blocks_[block].index(at.i, at.j)};
  }
  [[nodiscard]] int point(const Place& at) const { return borders_.point_of[at.block][at.node]; }
  std::size_t number(const Place& at, bool along_u) {
    return shared_.number({static_cast<int>(at.block), at.node, along_u});
  }
  [[nodiscard]] const Vec3& position(const Place& at) const { return blocks_[at.block].nodes[at.node]; }

  void add_surface(std::size_t b) {
    const Block& block = blocks_[b];
    CoonsSurface surface{knots_[b].u, knots_[b].v, std::vector<Node>(block.nodes.size())};
    const auto position = [&](std::size_t node) -> const Vec3& { return block.nodes[node]; };
    const std::vector<Vec3> su = differentiate(block, knots_[b], closed_[b], true, position, options_.splines);
    const std::vector<Vec3> sv = differentiate(block, knots_[b], closed_[b], false, position, options_.splines);
    for (std::size_t k = 0; k < block.nodes.size(); ++k) surface.nodes[k] = {block.nodes[k], su[k], sv[k], {}};
    surfaces_.push_back(std::move(surface));
  }

  /// Splines end with the derivatives that joined blocks share, and are shared along edges again.
  void fit_splines() {
    shared_.keep(Rank::across);
    std::vector<std::array<Prescribed, 2>> ends(blocks_.size());
    shared_.for_values([&](const SharedDerivatives::Slot& slot, const Vec3& value) {
      Prescribed& given = ends[static_cast<std::size_t>(slot.block)][slot.along_u ? 0 : 1];
      given.resize(surfaces_[static_cast<std::size_t>(slot.block)].nodes.size());
      given[slot.node] = value;
    });
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      std::vector<Node>& nodes = surfaces_[b].nodes;
      const auto position = [&](std::size_t node) -> const Vec3& { return nodes[node].s; };
      const std::vector<Vec3> su = differentiate(blocks_[b], knots_[b], closed_[b], true, position, true, ends[b][0]);
      const std::vector<Vec3> sv = differentiate(blocks_[b], knots_[b], closed_[b], false, position, true, ends[b][1]);
      for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k].su = su[k], nodes[k].sv = sv[k];
    }
    share_along_edges();
  }

  /// Returns whether a node has neighbours on both sides.
  [[nodiscard]] bool is_inner(const Place& at, bool along_u) const {
    const Block& block = blocks_[at.block];
    const int i = static_cast<int>(at.node) % block.columns, j = static_cast<int>(at.node) / block.columns;
    const int k = along_u ? i : j, n = along_u ? block.columns : block.rows;
    if (k == 0 || k + 1 == n) return along_u ? closed_[at.block].columns : closed_[at.block].rows;
    return along_u ? block.has(i - 1, j) && block.has(i + 1, j) : block.has(i, j - 1) && block.has(i, j + 1);
  }

  void offer(const Place& at, bool along_u) {
    const Node& node = surfaces_[at.block].nodes[at.node];
    shared_.offer(number(at, along_u), is_inner(at, along_u) ? Rank::inner : Rank::one_sided,
                  along_u ? node.su : node.sv);
  }

  /// All blocks have one derivative along an edge at each of its ends.
  void share_along_edges() {
    for (const auto& [ends, uses] : borders_.edges)
      for (const EdgeUse& use : uses) {
        const bool along_u = use.edge.along_u();
        const EdgeUse& first = uses.front();
        const Place start = place(use, use.edge.start()), end = place(use, use.edge.end());
        const Place first_start = place(first, first.edge.start()), first_end = place(first, first.edge.end());
        offer(start, along_u), offer(end, along_u);
        const bool same_way = point(start) == point(first_start);
        const int sign = same_way == (use.edge.forward() == first.edge.forward()) ? 1 : -1;
        shared_.unite(number(start, along_u), number(same_way ? first_start : first_end, first.edge.along_u()), sign);
        shared_.unite(number(end, along_u), number(same_way ? first_end : first_start, first.edge.along_u()), sign);
      }
  }

  [[nodiscard]] const std::vector<EdgeUse>& uses_of(std::size_t face, const BorderEdge& edge) const {
    const EdgeUse use{static_cast<int>(face), edge};
    const int a = point(place(use, edge.start())), b = point(place(use, edge.end()));
    return borders_.edges.at({std::min(a, b), std::max(a, b)});
  }

  [[nodiscard]] Vec3 normal(const Place& at) const {
    const Node& node = surfaces_[at.block].nodes[at.node];
    return cross(node.su, node.sv);
  }

  /// The place of the other use that has the same point.
  [[nodiscard]] Place same_place(const Place& at, const EdgeUse& other) const {
    const Place start = place(other, other.edge.start());
    return point(start) == point(at) ? start : place(other, other.edge.end());
  }

  [[nodiscard]] bool is_smooth(const EdgeUse& a, const EdgeUse& b) const {
    // Faces on both sides of an edge run along it in opposite directions when they have one orientation.
    const Place start = place(a, a.edge.start()), end = place(a, a.edge.end());
    const double turned = point(start) == point(place(b, b.edge.start())) ? -1 : 1;
    for (const Place& at : {start, end}) {
      const Vec3 n = normal(at), m = turned * normal(same_place(at, b));
      if (norm(n) * norm(m) > 0 && dot(n, m) < std::cos(options_.join_angle) * norm(n) * norm(m)) return false;
    }
    return true;
  }

  void join_chains() {
    for (const auto& [ends, uses] : borders_.edges) ++edges_at_[ends.first], ++edges_at_[ends.second];
    for (std::size_t face = 0; face < borders_.chains.size(); ++face)
      for (const Chain& chain : borders_.chains[face]) {
        if (chain.point) continue;
        bool smooth = true;
        for (const BorderEdge& edge : chain.edges) {
          const std::vector<EdgeUse>& uses = uses_of(face, edge);
          smooth = smooth && uses.size() == 2 && is_smooth(uses[0], uses[1]);
        }
        if (!smooth) continue;
        ++joined_;
        for (const BorderEdge& edge : chain.edges) {
          const std::vector<EdgeUse>& uses = uses_of(face, edge);
          join(uses[0], uses[1]);
          joined_edges_.push_back({&uses[0], &uses[1]});
        }
      }
  }

  [[nodiscard]] double height(const EdgeUse& use) const {
    const Knots& knots = knots_[block_of(use)];
    return use.edge.along_u() ? knots.v[static_cast<std::size_t>(use.edge.j) + 1] - knots.v[static_cast<std::size_t>(use.edge.j)]
                              : knots.u[static_cast<std::size_t>(use.edge.i) + 1] - knots.u[static_cast<std::size_t>(use.edge.i)];
  }

  /// The node of the cell behind a node of the edge.
  [[nodiscard]] Place behind(const EdgeUse& use, const Place& at) const {
    const bool start = place(use, use.edge.start()).node == at.node;
    return place(use, start ? use.edge.inner_start() : use.edge.inner_end());
  }

  /// Returns whether a line of block b is the continuation of a line of block a at an end of their edge. It is not
  /// where five blocks meet, nor where the lines turn.
  [[nodiscard]] bool goes_on(const EdgeUse& a, const EdgeUse& b, const Place& at) const {
    constexpr int regular = 4;
    if (const auto found = edges_at_.find(point(at)); found != edges_at_.end() && found->second > regular) return false;
    const Vec3 in = position(at) - position(behind(b, same_place(at, b))), out = position(behind(a, at)) - position(at);
    const double most = std::max(thresholds::closed_turn, options_.join_angle);
    return dot(in, out) > std::cos(most) * norm(in) * norm(out);
  }

  [[nodiscard]] const Vec3& derivative_across(const EdgeUse& use, const Place& at) const {
    const Node& node = surfaces_[at.block].nodes[at.node];
    return use.edge.along_u() ? node.sv : node.su;
  }

  /// The derivatives of a and b across their edge are one.
  void join(const EdgeUse& a, const EdgeUse& b) {
    for (const Place& at : {place(a, a.edge.start()), place(a, a.edge.end())}) {
      const Place other = same_place(at, b);
      if (!goes_on(a, b, at)) continue;
      const Sample before{-height(b), position(behind(b, other))}, here{0, position(at)},
          after{height(a), position(behind(a, at))};
      const Vec3 d = options_.splines ? Vec3((inward(a.edge) * derivative_across(a, at) - inward(b.edge) * derivative_across(b, other)) / 2)
                                      : parabola_derivative(before, here, after, 0);
      const std::size_t slot = number(at, !a.edge.along_u());
      shared_.unite(slot, number(other, !b.edge.along_u()), -inward(a.edge) * inward(b.edge));
      shared_.offer(slot, Rank::across, inward(a.edge) * d);
    }
  }

  /// Sv differenced along u and Su along v, [block][node]: equal inside a block.
  struct Twists {
    std::vector<Vec3> uv, vu;
    [[nodiscard]] const Vec3& along(const BorderEdge& edge, std::size_t node) const {
      return edge.along_u() ? uv[node] : vu[node];
    }
  };

  /// Twists of all blocks; prescribed[block][0] at ends of rows, [1] of columns.
  [[nodiscard]] std::vector<Twists> twists(const std::vector<std::array<Prescribed, 2>>& prescribed) const {
    std::vector<Twists> all;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const std::vector<Node>& nodes = surfaces_[b].nodes;
      const auto sv = [&](std::size_t node) -> const Vec3& { return nodes[node].sv; };
      const auto su = [&](std::size_t node) -> const Vec3& { return nodes[node].su; };
      all.push_back({differentiate(blocks_[b], knots_[b], closed_[b], true, sv, options_.splines, prescribed[b][0]),
                     differentiate(blocks_[b], knots_[b], closed_[b], false, su, options_.splines, prescribed[b][1])});
    }
    return all;
  }

  void add_cross_derivatives() {
    std::vector<std::array<Prescribed, 2>> prescribed(blocks_.size());
    std::vector<Twists> found = twists(prescribed);
    SharedDerivatives shared;
    share_twists(found, shared, prescribed);
    if (options_.splines && !joined_edges_.empty()) found = twists(prescribed);
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      for (std::size_t k = 0; k < surfaces_[b].nodes.size(); ++k) surfaces_[b].nodes[k].suv = (found[b].uv[k] + found[b].vu[k]) / 2;
    shared.for_values([&](const SharedDerivatives::Slot& at, const Vec3& value) {
      surfaces_[static_cast<std::size_t>(at.block)].nodes[at.node].suv = value;
    });
  }

  /// Derivatives that cross a joined edge are differenced along it, once for both blocks: then their derivatives across
  /// it agree at every point. Lines that cross the edge end with the shared twists.
  void share_twists(const std::vector<Twists>& twists, SharedDerivatives& shared, std::vector<std::array<Prescribed, 2>>& ends) const {
    const auto slot = [&](const Place& at) { return shared.number({static_cast<int>(at.block), at.node, false}); };
    for (const auto& [a, b] : joined_edges_) {
      const bool same_way = point(place(*a, a->edge.start())) == point(place(*b, b->edge.start()));
      const int along = same_way == (a->edge.forward() == b->edge.forward()) ? 1 : -1;
      const int across = -inward(a->edge) * inward(b->edge);
      for (const Place& at : {place(*a, a->edge.start()), place(*a, a->edge.end())}) {
        if (!goes_on(*a, *b, at)) continue;
        const Rank rank = is_inner(at, a->edge.along_u()) ? Rank::inner : Rank::one_sided;
        const Place other = same_place(at, *b);
        shared.unite(slot(at), slot(other), along * across);
        shared.offer(slot(at), rank, twists[at.block].along(a->edge, at.node));
        for (const auto& [use, end] : {std::pair{a, at}, std::pair{b, other}}) {
          Prescribed& given = ends[end.block][use->edge.along_u() ? 1 : 0];
          given.resize(surfaces_[end.block].nodes.size());
          given[end.node] = Vec3::Zero();  // until all are known
        }
      }
    }
    shared.for_values([&](const SharedDerivatives::Slot& at, const Vec3& value) {
      for (Prescribed& given : ends[static_cast<std::size_t>(at.block)])
        if (!given.empty() && given[at.node]) given[at.node] = value;
    });
  }

  const std::vector<Block>& blocks_;
  const Borders& borders_;
  const std::vector<Knots>& knots_;
  const std::vector<Closed>& closed_;
  const Options& options_;
  std::vector<CoonsSurface> surfaces_;
  SharedDerivatives shared_;
  std::size_t joined_ = 0;
  std::unordered_map<int, int> edges_at_;  // how many edges meet at a point
  std::vector<std::pair<const EdgeUse*, const EdgeUse*>> joined_edges_;
};

}  // namespace

std::vector<CoonsSurface> interpolate(const std::vector<Block>& blocks, const Borders& borders,
                                      const std::vector<Knots>& knots, const std::vector<Closed>& closed,
                                      const Options& options, std::size_t* joined) {
  Interpolator interpolator(blocks, borders, knots, closed, options);
  std::vector<CoonsSurface> surfaces = interpolator.run();
  if (joined != nullptr) *joined = interpolator.joined();
  return surfaces;
}

}  // namespace carreau::grid
