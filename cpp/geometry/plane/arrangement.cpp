// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/arrangement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "predicates/edge_grid.h"
#include "predicates/predicates.h"
#include "support/error.h"

namespace carreau {

namespace {

/// Share of the diagonal within which a rounded crossing is an existing point: some ulps of its coordinates.
constexpr double same_point = 4e-13;
/// Rounds of division: the pieces of a round may cross by rounding in the next one.
constexpr int max_rounds = 20;

bool between(const Vec2& a, const Vec2& b, const Vec2& p) noexcept {
  return p.x() >= std::min(a.x(), b.x()) && p.x() <= std::max(a.x(), b.x()) && p.y() >= std::min(a.y(), b.y()) &&
         p.y() <= std::max(a.y(), b.y());
}

class Arranger {
 public:
  explicit Arranger(PlaneDomainInput& input) : input_(input) {}

  SegmentArrangement run() {
    merge_points();
    for (int round = 0; round < max_rounds; ++round) {
      drop_repeated();
      if (!divide()) return counts_;
    }
    const PlaneCurve& curve = input_.curves[static_cast<std::size_t>(last_)];
    throw InvalidModel(Where{.file = input_.source, .line = curve.line},
                       "segments cross so often near segment " + curve.name + " that rounded crossings do not part them");
  }

 private:
  [[nodiscard]] const Vec2& at(int point) const { return input_.points[static_cast<std::size_t>(point)].xy; }
  [[nodiscard]] int first(int curve) const { return input_.curves[static_cast<std::size_t>(curve)].points[0]; }
  [[nodiscard]] int second(int curve) const { return input_.curves[static_cast<std::size_t>(curve)].points[1]; }

  void merge_points() {
    std::map<std::pair<double, double>, int> known;
    std::vector<int> rank(input_.points.size());
    std::vector<PlanePoint> kept;
    for (std::size_t i = 0; i < input_.points.size(); ++i) {
      PlanePoint& point = input_.points[i];
      const Vec2 xy = point.xy + Vec2::Zero();  // -0 and 0 are equal
      const auto [found, added] = known.emplace(std::pair(xy.x(), xy.y()), static_cast<int>(kept.size()));
      rank[i] = found->second;
      if (added) {
        kept.push_back(std::move(point));
        continue;
      }
      ++counts_.merged_points;
      PlanePoint& earlier = kept[static_cast<std::size_t>(found->second)];
      if (earlier.ref == 0) earlier.ref = point.ref;
      earlier.imposed = earlier.imposed || point.imposed;
    }
    input_.points = std::move(kept);
    Vec2 low = Vec2::Zero(), high = low;  // from the origin: rounding grows with coordinates
    for (const PlanePoint& point : input_.points) low = low.cwiseMin(point.xy), high = high.cwiseMax(point.xy);
    constexpr double no_extent = 1;  // all points are the origin: no segments cross
    tolerance_ = high == low ? no_extent : same_point * norm(Vec2(high - low));
    for (std::size_t p = 0; p < input_.points.size(); ++p)
      cells_.emplace(cell_of(input_.points[p].xy), static_cast<int>(p));
    for (PlaneCurve& curve : input_.curves)
      for (int& p : curve.points) p = rank[static_cast<std::size_t>(p)];
  }

  void drop_repeated() {
    std::map<std::pair<int, int>, std::size_t> known;
    std::vector<PlaneCurve> kept;
    for (PlaneCurve& curve : input_.curves) {
      const auto key = std::minmax(curve.points[0], curve.points[1]);
      const auto [found, added] = known.emplace(std::pair<int, int>(key), kept.size());
      if (key.first != key.second && added) {
        kept.push_back(std::move(curve));
        continue;
      }
      if (key.first == key.second) known.erase(found);
      else if (kept[found->second].ref == 0) kept[found->second].ref = curve.ref;
      ++counts_.dropped_segments;
    }
    input_.curves = std::move(kept);
  }

  /// Divides all segments at the points that they meet; returns false if they meet at their ends alone.
  bool divide() {
    const std::size_t n = input_.curves.size();
    if (n == 0) return false;
    std::vector<Vec2> vertices;
    for (const PlanePoint& point : input_.points) vertices.push_back(point.xy);
    std::vector<std::pair<int, int>> edges;
    for (std::size_t c = 0; c < n; ++c) edges.emplace_back(first(static_cast<int>(c)), second(static_cast<int>(c)));
    const EdgeGrid grid(vertices, edges);
    on_.assign(n, {});
    find_points(grid);
    find_crossings(grid);
    std::vector<PlaneCurve> pieces;
    for (std::size_t c = 0; c < n; ++c) add_pieces(static_cast<int>(c), pieces);
    const bool any = pieces.size() != n;
    input_.curves = std::move(pieces);
    return any;
  }

  /// Points of the input that lie on a segment, not at its ends.
  void find_points(const EdgeGrid& grid) {
    for (int p = 0; p < static_cast<int>(input_.points.size()); ++p)
      for (const int c : grid.edges_in(grid.column_of(at(p).x()), grid.row_of(at(p).y()))) {
        const int a = first(c), b = second(c);
        if (p == a || p == b || !between(at(a), at(b), at(p)) || orientation(at(a), at(b), at(p)) != 0) continue;
        if (on_[static_cast<std::size_t>(c)].insert(p).second) ++counts_.points_on_segments;
      }
  }

  void find_crossings(const EdgeGrid& grid) {
    std::set<std::pair<int, int>> pairs;
    for (int row = 0; row < grid.rows(); ++row)
      for (int column = 0; column < grid.columns(); ++column) {
        const auto here = grid.edges_in(column, row);
        for (std::size_t i = 0; i < here.size(); ++i)
          for (std::size_t j = i + 1; j < here.size(); ++j)
            if (cross_inside(here[i], here[j])) pairs.insert(std::minmax(here[i], here[j]));
      }
    for (const auto& [c, d] : pairs) {
      const int p = crossing_of(c, d);
      for (const int each : {c, d})
        if (p != first(each) && p != second(each)) on_[static_cast<std::size_t>(each)].insert(p);
      last_ = d;
    }
  }

  [[nodiscard]] bool cross_inside(int c, int d) const {
    const Vec2 &a = at(first(c)), &b = at(second(c)), &e = at(first(d)), &f = at(second(d));
    return orientation(a, b, e) * orientation(a, b, f) < 0 && orientation(e, f, a) * orientation(e, f, b) < 0;
  }

  using CellOfGrid = std::pair<double, double>;
  [[nodiscard]] CellOfGrid cell_of(const Vec2& x) const {
    return {std::floor(x.x() / tolerance_), std::floor(x.y() / tolerance_)};
  }

  /// -1: no point within the tolerance.
  [[nodiscard]] int point_near(const Vec2& x) const {
    const auto [column, row] = cell_of(x);
    for (const double i : {-1.0, 0.0, 1.0})
      for (const double j : {-1.0, 0.0, 1.0}) {
        const auto [begin, end] = cells_.equal_range({column + i, row + j});
        for (auto each = begin; each != end; ++each)
          if (norm(Vec2(at(each->second) - x)) <= tolerance_) return each->second;
      }
    return -1;
  }

  /// The point of a crossing: an existing point, else a new one.
  int crossing_of(int c, int d) {
    const Vec2 a = at(first(c)), b = at(second(c)), e = at(first(d)), f = at(second(d));
    const Vec2 ab = b - a, ef = f - e;
    const double whole = cross(ab, ef), share = whole == 0 ? 0.5 : cross(Vec2(e - a), ef) / whole;
    const Vec2 x = a + std::clamp(share, 0.0, 1.0) * ab;
    // Crossings of several segments in one point differ by rounding.
    if (const int near = point_near(x); near >= 0) return near;
    const int p = static_cast<int>(input_.points.size());
    cells_.emplace(cell_of(x), p);
    ++counts_.crossings;
    PlanePoint point;
    point.xy = x, point.line = input_.curves[static_cast<std::size_t>(c)].line;
    point.name = "at the crossing of segments " + input_.curves[static_cast<std::size_t>(c)].name + " and " +
                 input_.curves[static_cast<std::size_t>(d)].name;
    input_.points.push_back(std::move(point));
    return p;
  }

  void add_pieces(int c, std::vector<PlaneCurve>& pieces) const {
    const PlaneCurve& curve = input_.curves[static_cast<std::size_t>(c)];
    const Vec2 start = at(first(c)), along = at(second(c)) - start;
    std::vector<std::pair<double, int>> stops;
    for (const int p : on_[static_cast<std::size_t>(c)]) stops.emplace_back(dot(Vec2(at(p) - start), along), p);
    std::ranges::sort(stops);
    int before = first(c);
    stops.emplace_back(0, second(c));
    for (const auto& [share, p] : stops) {
      PlaneCurve& piece = pieces.emplace_back(curve);
      piece.points = {before, p};
      before = p;
    }
  }

  PlaneDomainInput& input_;
  SegmentArrangement counts_;
  double tolerance_ = 0;
  std::vector<std::set<int>> on_;                     // by segment: points that divide it
  std::multimap<std::pair<double, double>, int> cells_;  // points by cells of a grid
  int last_ = 0;                                      // a segment that crossed another
};

}  // namespace

SegmentArrangement arrange_segments(PlaneDomainInput& input) { return Arranger(input).run(); }

}  // namespace carreau
