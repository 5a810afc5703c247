// SPDX-License-Identifier: BSD-3-Clause
#include "domain_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace carreau_occ {
namespace {

/// 0: lines of constant u, along which v varies; 1: of constant v.
double across(int direction, const gp_Pnt2d& p) { return direction == 0 ? p.X() : p.Y(); }
double coordinate_along(int direction, const gp_Pnt2d& p) { return direction == 0 ? p.Y() : p.X(); }
gp_Pnt2d place(int direction, double across, double along) {
  return direction == 0 ? gp_Pnt2d(across, along) : gp_Pnt2d(along, across);
}
double near_of(int direction, const gp_XY& near) { return direction == 0 ? near.X() : near.Y(); }

/// A place on a line where the boundary meets it, or another line does.
struct Node {
  double along = 0;
  int vertex = 0;
  gp_Pnt2d uv;
};

/// True if a point is inside closed polylines, by the sides that a ray along u meets.
class Inside {
 public:
  void add(const std::vector<gp_Pnt2d>& polyline) { polylines_.push_back(&polyline); }
  [[nodiscard]] bool operator()(const gp_Pnt2d& p, int direction) const {
    bool inside = false;
    for (const std::vector<gp_Pnt2d>* line : polylines_)
      for (std::size_t i = 1; i < line->size(); ++i) {
        const gp_Pnt2d &a = (*line)[i - 1], &b = (*line)[i];
        const double m = coordinate_along(direction, p), s = coordinate_along(direction, a), t = coordinate_along(direction, b);
        if ((s > m) == (t > m)) continue;
        const double x = across(direction, a) + (m - s) / (t - s) * (across(direction, b) - across(direction, a));
        if (x > across(direction, p)) inside = !inside;
      }
    return inside;
  }

 private:
  std::vector<const std::vector<gp_Pnt2d>*> polylines_;
};

class Cutter {
 public:
  Cutter(const std::vector<DomainArc>& arcs, const CutLines& lines, gp_XY near, int next_vertex)
      : arcs_(arcs), lines_{lines.u, lines.v}, near_(near), next_vertex_(next_vertex) {}

  std::optional<DomainCut> run() {
    for (const DomainArc& arc : arcs_)
      if (!arc.internal) boundary_.add(arc.samples);
    nodes_[0].resize(lines_[0].size()), nodes_[1].resize(lines_[1].size());
    covered_[0].resize(lines_[0].size()), covered_[1].resize(lines_[1].size());
    for (std::size_t i = 0; i < arcs_.size(); ++i)
      if (!place_arc(static_cast<int>(i))) return std::nullopt;
    add_crossings();
    for (const int direction : {0, 1})
      for (std::size_t k = 0; k < lines_[direction].size(); ++k) add_edges(direction, k);
    for (const auto& [cell, uses] : cells_)
      if (!add_parts(cell, uses)) return std::nullopt;
    return std::move(cut_);
  }

 private:
  using Cell = std::array<int, 2>;

  /// Into its cell; its ends onto the lines where they lie. False: a line crosses it.
  bool place_arc(int index) {
    const DomainArc& arc = arcs_[static_cast<std::size_t>(index)];
    Cell cell{0, 0};
    int on_both_sides = -1;
    bool left_is_above = false;
    for (const int direction : {0, 1})
      for (std::size_t k = 0; k < lines_[direction].size(); ++k) {
        const double at = lines_[direction][k], near = near_of(direction, near_);
        double low = 0, high = 0;
        std::size_t on_line = 0;
        for (const gp_Pnt2d& p : arc.samples) {
          const double height = across(direction, p) - at;
          low = std::min(low, height), high = std::max(high, height);
          on_line += std::abs(height) <= near ? 1 : 0;
        }
        for (const bool last : {false, true}) {
          const gp_Pnt2d& p = last ? arc.samples.back() : arc.samples.front();
          if (std::abs(across(direction, p) - at) <= near)
            add_node(direction, k, {coordinate_along(direction, p), last ? arc.end2 : arc.end1, p});
        }
        // Beside its ends it may be off by the tolerances of vertices.
        constexpr double most = 0.8, astray = 16;
        bool above = high > -low;
        if (static_cast<double>(on_line) > most * static_cast<double>(arc.samples.size())) {
          const double from = coordinate_along(direction, arc.samples.front()), to = coordinate_along(direction, arc.samples.back());
          covered_[direction][k].push_back(std::minmax(from, to));
          // Small u lies on the left of rising curves, large v on the left of curves to the right.
          above = ((from < to) == arc.forward) == (direction == 1);
          if (arc.internal) on_both_sides = direction, left_is_above = above;
        } else if (std::min(high, -low) > astray * near) {
          return false;
        }
        if (above) ++cell[static_cast<std::size_t>(direction)];
      }
    cells_[cell].push_back({index, arc.forward, arc.internal && on_both_sides < 0});
    if (on_both_sides < 0) return true;
    // Taken for a boundary of the part on its left above; the other one has it the other way round.
    int& rank = cell[static_cast<std::size_t>(on_both_sides)];
    rank += left_is_above ? -1 : 1;
    cells_[cell].push_back({index, !arc.forward, false});
    return true;
  }

  void add_node(int direction, std::size_t k, const Node& node) {
    const double near = 4 * near_of(1 - direction, near_);
    std::vector<Node>& nodes = nodes_[direction][k];
    const bool known = std::any_of(nodes.begin(), nodes.end(), [&](const Node& n) {
      return n.vertex == node.vertex && std::abs(n.along - node.along) <= near;
    });
    if (!known) nodes.push_back(node);
  }

  void add_crossings() {
    constexpr double aside = 1e-5;  // of the extent: avoids polylines that lie along the lines
    double extent[2] = {0, 0};
    for (const int direction : {0, 1}) {
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (const DomainArc& arc : arcs_)
        for (const gp_Pnt2d& p : arc.samples)
          low = std::min(low, across(direction, p)), high = std::max(high, across(direction, p));
      extent[direction] = high - low;
    }
    for (std::size_t i = 0; i < lines_[0].size(); ++i)
      for (std::size_t j = 0; j < lines_[1].size(); ++j) {
        const gp_Pnt2d p(lines_[0][i], lines_[1][j]);
        const auto meets = [&](int direction, std::size_t k) {
          const double near = 4 * near_of(1 - direction, near_);
          return std::any_of(nodes_[direction][k].begin(), nodes_[direction][k].end(),
                             [&](const Node& n) { return std::abs(n.along - coordinate_along(direction, p)) <= near; });
        };
        if (meets(0, i) || meets(1, j)) continue;
        if (!boundary_(p.XY() + gp_XY(aside * extent[0], 0.37 * aside * extent[1]), 0)) continue;
        const int vertex = next_vertex_ + static_cast<int>(cut_.vertices.size());
        cut_.vertices.push_back(p);
        nodes_[0][i].push_back({p.Y(), vertex, p});
        nodes_[1][j].push_back({p.X(), vertex, p});
      }
  }

  /// The pieces of a line that are inside the domain.
  void add_edges(int direction, std::size_t k) {
    constexpr double somewhere = 0.4371;  // of a piece: not its middle, where symmetric curves cross
    std::vector<Node>& nodes = nodes_[direction][k];
    std::sort(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.along < b.along; });
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      const Node &a = nodes[i - 1], &b = nodes[i];
      if (b.along - a.along <= 4 * near_of(1 - direction, near_)) continue;
      const double at = a.along + somewhere * (b.along - a.along);
      const auto& covered = covered_[direction][k];
      if (std::any_of(covered.begin(), covered.end(), [&](const auto& c) { return c.first < at && at < c.second; }))
        continue;
      if (!boundary_(place(direction, lines_[direction][k], at), direction)) continue;
      const int edge = static_cast<int>(arcs_.size() + cut_.edges.size());
      cut_.edges.push_back({a.uv, b.uv, a.vertex, b.vertex});
      for (const bool above : {false, true}) {
        Cell cell{0, 0};
        const auto& other = lines_[1 - direction];
        cell[static_cast<std::size_t>(direction)] = static_cast<int>(k) + (above ? 1 : 0);
        cell[static_cast<std::size_t>(1 - direction)] =
            static_cast<int>(std::lower_bound(other.begin(), other.end(), at) - other.begin());
        cells_[cell].push_back({edge, above == (direction == 1), false});
      }
    }
  }

  [[nodiscard]] std::vector<gp_Pnt2d> points_of(const CutPart::Use& use) const {
    const auto index = static_cast<std::size_t>(use.curve);
    std::vector<gp_Pnt2d> points;
    if (index < arcs_.size())
      points = arcs_[index].samples;
    else
      points = {cut_.edges[index - arcs_.size()].from, cut_.edges[index - arcs_.size()].to};
    if (!use.forward) std::reverse(points.begin(), points.end());
    return points;
  }
  [[nodiscard]] std::array<int, 2> ends_of(const CutPart::Use& use) const {
    const auto index = static_cast<std::size_t>(use.curve);
    std::array<int, 2> ends{};
    if (index < arcs_.size())
      ends = {arcs_[index].end1, arcs_[index].end2};
    else
      ends = {cut_.edges[index - arcs_.size()].end1, cut_.edges[index - arcs_.size()].end2};
    if (!use.forward) std::swap(ends[0], ends[1]);
    return ends;
  }
  /// Loops of a cell that touch.
  struct Group {
    std::vector<CutPart::Use> uses;
    double area = 0;  // negative: holes
    Inside inside;
    gp_Pnt2d somewhere;  // on it
    int part = -1;
  };

  bool add_parts(const Cell& cell, const std::vector<CutPart::Use>& uses) {
    std::vector<std::vector<gp_Pnt2d>> points;
    for (const CutPart::Use& use : uses) points.push_back(points_of(use));
    std::vector<Group> groups;
    if (!gather(uses, points, groups)) return false;
    std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.area > b.area; });
    const auto first = static_cast<int>(cut_.parts.size());
    for (Group& group : groups)
      if (group.area > 0) {
        group.part = static_cast<int>(cut_.parts.size());
        cut_.parts.push_back({group.uses});
        set_cell(cell, cut_.parts.back());
      }
    if (static_cast<int>(cut_.parts.size()) == first) return false;
    // The smallest one that holds it, which is the last of those.
    const auto part_around = [&](const gp_Pnt2d& p) {
      int part = -1;
      for (const Group& group : groups)
        if (group.part >= 0 && group.inside(p, 0)) part = group.part;
      return part;
    };
    for (const Group& group : groups) {
      if (group.part >= 0) continue;
      const int part = part_around(group.somewhere);
      if (part < 0) return false;
      auto& all = cut_.parts[static_cast<std::size_t>(part)].uses;
      all.insert(all.end(), group.uses.begin(), group.uses.end());
    }
    for (std::size_t i = 0; i < uses.size(); ++i) {
      if (!uses[i].internal) continue;
      const int part = part_around(middle_of(points[i]));
      if (part < 0) return false;
      cut_.parts[static_cast<std::size_t>(part)].uses.push_back(uses[i]);
    }
    return true;
  }

  static gp_Pnt2d middle_of(const std::vector<gp_Pnt2d>& points) {
    const gp_Pnt2d &a = points[(points.size() - 1) / 2], &b = points[(points.size() - 1) / 2 + 1];
    return {(a.X() + b.X()) / 2, (a.Y() + b.Y()) / 2};
  }

  void set_cell(const Cell& cell, CutPart& part) const {
    for (const int direction : {0, 1}) {
      const std::vector<double>& lines = lines_[direction];
      const auto k = static_cast<std::size_t>(cell[static_cast<std::size_t>(direction)]);
      if (k > 0) part.low.SetCoord(direction + 1, lines[k - 1]);
      if (k < lines.size()) part.high.SetCoord(direction + 1, lines[k]);
    }
  }

  /// False: a loop does not close, or has no area.
  bool gather(const std::vector<CutPart::Use>& uses, const std::vector<std::vector<gp_Pnt2d>>& points,
              std::vector<Group>& groups) const {
    struct Place {
      int vertex = 0;
      gp_Pnt2d uv;
      int balance = 0;  // leaving curves less arriving curves
      std::size_t top = 0;
    };
    constexpr double apart = 0.01;  // of the cell: images of one vertex that a seam or a pole has
    gp_XY low(HUGE_VAL, HUGE_VAL), high(-HUGE_VAL, -HUGE_VAL);
    for (const auto& line : points)
      for (const gp_Pnt2d& p : line) {
        low.SetCoord(std::min(low.X(), p.X()), std::min(low.Y(), p.Y()));
        high.SetCoord(std::max(high.X(), p.X()), std::max(high.Y(), p.Y()));
      }
    const gp_XY extent = high - low;
    std::vector<Place> places;
    const auto place_of = [&](int vertex, const gp_Pnt2d& uv, int balance) {
      std::size_t i = 0;
      while (i < places.size() &&
             !(places[i].vertex == vertex && std::abs(places[i].uv.X() - uv.X()) <= apart * extent.X() &&
               std::abs(places[i].uv.Y() - uv.Y()) <= apart * extent.Y()))
        ++i;
      if (i == places.size()) places.push_back({vertex, uv, 0, i});
      places[i].balance += balance;
      return i;
    };
    const auto top = [&](std::size_t i) {
      while (places[i].top != i) i = places[i].top;
      return i;
    };
    std::vector<std::size_t> start(uses.size(), 0);
    for (std::size_t i = 0; i < uses.size(); ++i) {
      if (uses[i].internal) continue;
      const auto ends = ends_of(uses[i]);
      start[i] = place_of(ends[0], points[i].front(), 1);
      const std::size_t a = top(start[i]), b = top(place_of(ends[1], points[i].back(), -1));
      places[std::max(a, b)].top = std::min(a, b);
    }
    if (std::any_of(places.begin(), places.end(), [](const Place& p) { return p.balance != 0; })) return false;
    std::map<std::size_t, Group> found;
    for (std::size_t i = 0; i < uses.size(); ++i) {
      if (uses[i].internal) continue;
      Group& group = found[top(start[i])];
      group.uses.push_back(uses[i]);
      group.inside.add(points[i]);
      group.somewhere = middle_of(points[i]);
      for (std::size_t k = 1; k < points[i].size(); ++k)
        group.area += ((points[i][k - 1].XY() - low) ^ (points[i][k].XY() - low)) / 2;
    }
    constexpr double least = 1e-12;
    for (auto& [place, group] : found) {
      if (!(std::abs(group.area) > least * extent.X() * extent.Y())) return false;
      groups.push_back(std::move(group));
    }
    return true;
  }

  const std::vector<DomainArc>& arcs_;
  std::array<std::vector<double>, 2> lines_;
  gp_XY near_;
  int next_vertex_;
  Inside boundary_;
  std::array<std::vector<std::vector<Node>>, 2> nodes_;                         // [direction][line]
  std::array<std::vector<std::vector<std::pair<double, double>>>, 2> covered_;  // by curves along it
  std::map<Cell, std::vector<CutPart::Use>> cells_;
  DomainCut cut_;
};

}  // namespace

std::optional<DomainCut> cut_domain(const std::vector<DomainArc>& arcs, const CutLines& lines, gp_XY near,
                                    int next_vertex) {
  return Cutter(arcs, lines, near, next_vertex).run();
}

}  // namespace carreau_occ
