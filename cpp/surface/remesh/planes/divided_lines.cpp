// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <set>

#include "curve/unit_discretisation.h"
#include "surface/remesh/planes/borders.h"

namespace carreau {

namespace {

/// Ranks of the vertices of the line that take the n + 1 places at `to`: ascending, both ends at the ends.
std::vector<std::size_t> nearest_ranks(const std::vector<double>& arcs, const std::vector<double>& to) {
  std::vector<std::size_t> ranks{0};
  const std::size_t last = arcs.size() - 1, n = to.size() - 1;
  for (std::size_t j = 1; j < n; ++j) {
    const auto after = static_cast<std::size_t>(std::ranges::upper_bound(arcs, to[j]) - arcs.begin());
    const std::size_t nearest = after <= last && arcs[after] - to[j] < to[j] - arcs[after - 1] ? after : after - 1;
    ranks.push_back(std::clamp(nearest, ranks.back() + 1, last - (n - j)));
  }
  ranks.push_back(last);
  return ranks;
}

/// A sharp edge of the atlas, seen along its line: charts on its left and on its right.
struct Sides {
  std::int32_t left = -1, right = -1;
  friend bool operator==(const Sides&, const Sides&) = default;
};

std::optional<Sides> sides_of(const BorderInput& input, std::int32_t from, std::int32_t to) {
  Sides sides;
  for (const Charts::OnEdge& on : input.atlas.charts.triangles_on(mesh_edge(from, to))) {
    const bool forward = input.atlas.at(on.triangle).vertex[on.side] == from;
    std::int32_t& side = forward ? sides.left : sides.right;
    if (side >= 0) return {};
    side = input.charts.chart[on.triangle];
  }
  return sides;
}

bool is_exact(const BorderInput& input, std::size_t line) {
  const std::vector<std::int32_t>& v = input.lines[line].vertices;
  if (std::ranges::any_of(v, [&](std::int32_t w) { return input.kept[w] != 0; })) return true;
  for (std::size_t k = 1; k < v.size(); ++k)
    for (const Charts::OnEdge& on : input.atlas.charts.triangles_on(mesh_edge(v[k - 1], v[k])))
      if (input.exact[input.charts.chart[on.triangle]] != 0) return true;
  return false;
}

DividedLine every_vertex(const BorderInput& input, std::size_t line) {
  DividedLine divided;
  const std::vector<double>& arcs = input.worked[line].places->arcs();
  for (std::size_t k = 0; k < arcs.size(); ++k) divided.nodes.push_back({input.lines[line].vertices[k], arcs[k]});
  divided.places.resize(arcs.size());
  return divided;
}

/// Edges of a divided line in runs between the same charts: where these change, the nearest vertex is taken.
bool add_runs(const BorderInput& input, std::size_t line, const std::vector<LineNode>& nodes, Borders& borders) {
  const std::vector<std::int32_t>& v = input.lines[line].vertices;
  const std::vector<double>& arcs = input.worked[line].places->arcs();
  std::optional<Sides> current = sides_of(input, v[0], v[1]);
  std::size_t from = 0;
  for (std::size_t k = 1; k < v.size(); ++k) {
    const std::optional<Sides> next = k + 1 < v.size() ? sides_of(input, v[k], v[k + 1]) : std::nullopt;
    if (!current || (k + 1 < v.size() && !next)) return false;
    if (next == current) continue;
    const std::size_t to = k + 1 < v.size() ? nearest_node(nodes, arcs[k]) : nodes.size() - 1;
    if (to > from) {
      BorderChain& chain = borders.chains.emplace_back();
      chain.left = current->left, chain.right = current->right;
      for (std::size_t j = from; j <= to; ++j) chain.vertices.push_back(nodes[j].vertex);
    }
    from = to, current = next;
  }
  return true;
}

}  // namespace

std::size_t nearest_node(const std::vector<LineNode>& nodes, double arc) {
  const auto after = std::ranges::upper_bound(nodes, arc, {}, &LineNode::arc);
  if (after == nodes.begin()) return 0;
  const auto before = after - 1;
  const bool next = after != nodes.end() && after->arc - arc < arc - before->arc;
  return static_cast<std::size_t>((next ? after : before) - nodes.begin());
}

std::optional<DividedLine> divide_line(const BorderInput& input, std::size_t rank, int at_least) {
  const SharpLine& line = input.lines[rank];
  const WorkedLine& worked = input.worked[rank];
  const std::vector<double>& arcs = worked.places->arcs();
  std::vector<double> h;
  for (const std::int32_t v : line.vertices) h.push_back(input.size[v]);
  for (int least = std::max(at_least, line.closed() ? 3 : 1); least < static_cast<int>(arcs.size()); ++least) {
    const std::vector<double> to = split_by_sizes(arcs, h, SizeLaw::linear, least);
    if (to.size() > arcs.size()) return {};
    const std::vector<std::size_t> ranks = nearest_ranks(arcs, to);
    DividedLine divided;
    for (std::size_t j = 0; j < to.size(); ++j) {
      divided.nodes.push_back({line.vertices[ranks[j]], to[j]});
      const bool end = j == 0 || j + 1 == to.size();
      divided.places.push_back(end ? KeptPlaces{} : worked.places->at(to[j]));
    }
    const auto at = [&](std::size_t j) {
      return divided.places[j].empty() ? input.atlas.xyz(divided.nodes[j].vertex) : divided.places[j].front().xyz;
    };
    bool near = true;
    for (std::size_t j = 1; near && j < to.size(); ++j)
      near = worked.places->distance(to[j - 1], to[j], at(j - 1), at(j)) <= input.tolerance.deviation_at(h[ranks[j]]);
    if (near) return divided;
    least = std::max(least, static_cast<int>(to.size()) - 1);
  }
  return {};
}

namespace {

/// The line with the nodes of its twin at the same shares of its length. Returns nothing if it has fewer vertices.
std::optional<DividedLine> divide_like(const BorderInput& input, std::size_t rank, const std::vector<LineNode>& twin) {
  const WorkedLine& worked = input.worked[rank];
  const std::vector<double>& arcs = worked.places->arcs();
  if (twin.size() > arcs.size()) return {};
  std::vector<double> to;
  for (const LineNode& node : twin) to.push_back(node.arc / twin.back().arc * arcs.back());
  const std::vector<std::size_t> ranks = nearest_ranks(arcs, to);
  DividedLine divided;
  for (std::size_t j = 0; j < to.size(); ++j) {
    const bool end = j == 0 || j + 1 == to.size();
    divided.nodes.push_back({input.lines[rank].vertices[ranks[j]], end ? arcs[ranks[j]] : to[j]});
    divided.places.push_back(end ? KeptPlaces{} : worked.places->at(to[j]));
  }
  return divided;
}

}  // namespace

std::optional<Borders> cut_borders(const BorderInput& input, Monitor& monitor) {
  Borders borders;
  borders.number.assign(input.atlas.mesh.vertices.size(), -1);
  std::set<MeshEdge> lone;  // lines of one edge
  for (std::size_t line = 0; line < input.lines.size(); ++line) {
    monitor.checkpoint();
    const bool exact = is_exact(input, line);
    const std::int32_t twin = input.twin.empty() ? -1 : input.twin[line];
    const bool follows = twin >= 0 && twin < static_cast<std::int32_t>(line);
    std::optional<DividedLine> divided = follows ? divide_like(input, line, borders.lines[twin])
                                         : exact ? every_vertex(input, line)
                                                 : divide_line(input, line, 1);
    if (!divided && follows) return {};
    if (!exact && !follows && divided && divided->nodes.size() == 2) {
      const auto& [first, last] = std::pair{divided->nodes.front().vertex, divided->nodes.back().vertex};
      if (!lone.insert(mesh_edge(first, last)).second) divided = divide_line(input, line, 2);
    }
    if (!divided) divided = every_vertex(input, line);
    if (!add_runs(input, line, divided->nodes, borders)) return {};
    borders.lines.push_back(std::move(divided->nodes));
    borders.on_line.push_back(std::move(divided->places));
  }
  const LinePoints points(input, borders);
  trace_cuts(input, points, borders, monitor);
  return borders;
}

LinePoints::LinePoints(const BorderInput& input, const Borders& borders) : point_(input.atlas.mesh.vertices.size()) {
  for (std::size_t line = 0; line < input.lines.size(); ++line) {
    const std::vector<std::int32_t>& v = input.lines[line].vertices;
    const std::vector<double>& arcs = input.worked[line].places->arcs();
    for (std::size_t k = 0; k < v.size(); ++k) {
      std::size_t j = nearest_node(borders.lines[line], arcs[k]);
      if (k == 0) j = 0;
      if (k + 1 == v.size()) j = borders.lines[line].size() - 1;
      const std::int32_t vertex = borders.lines[line][j].vertex;
      const KeptPlaces& places = borders.on_line[line][j];
      point_[v[k]] = {vertex, places.empty() ? input.atlas.xyz(vertex) : places.front().xyz};
    }
  }
}

}  // namespace carreau
