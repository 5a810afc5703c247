// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/planes/find_charts.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>

#include "support/infinity.h"
#include "surface/remesh/planes/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::planes;

constexpr std::int32_t none = -1;

class ChartFinder {
 public:
  ChartFinder(const FlatAtlas& atlas, ProjectedCharts found, Monitor& monitor)
      : atlas_(atlas), monitor_(monitor), found_(std::move(found)) {
    mark_.resize(atlas.normal.size(), 0);
  }
  ChartFinder(const FlatAtlas& atlas, Monitor& monitor) : atlas_(atlas), monitor_(monitor) {
    found_.chart.assign(atlas.normal.size(), none);
  }

  ProjectedCharts split(const std::vector<char>& which) {
    std::vector<Triangles> members(found_.axis.size());
    for (std::int32_t t = 0; t < atlas_.triangles(); ++t)
      if (which[found_.chart[t]] != 0) members[found_.chart[t]].push_back(t);
    for (std::size_t c = 0; c < members.size(); ++c)
      if (members[c].size() > 1) split(members[c], static_cast<std::int32_t>(c));
    return std::move(found_);
  }

  ProjectedCharts run() {
    std::vector<char> met(atlas_.normal.size(), 0);
    for (std::int32_t t = 0; t < atlas_.triangles(); ++t)
      if (met[t] == 0) cut(region_of(t, met));
    merge_charts(atlas_, merge_cosine, {}, found_, monitor_);
    found_.exact.assign(atlas_.normal.size(), 0);
    found_.kept.assign(atlas_.normal.size(), 0);
    std::vector<char> leaning(atlas_.normal.size(), 0);
    for (std::int32_t t = 0; t < atlas_.triangles(); ++t)
      leaning[t] = lean(t, found_.chart[t]) >= loose_cosine ? 0 : 1;
    keep_triangles(atlas_, leaning, found_);
    return found_;
  }

 private:
  using Triangles = std::vector<std::int32_t>;
  struct Seed {
    std::int32_t triangle, chart;
  };

  [[nodiscard]] double lean(std::int32_t t, std::int32_t chart) const {
    return dot(atlas_.normal[t], found_.axis[chart]);
  }

  void split(const Triangles& some, std::int32_t chart) {
    const auto other = static_cast<std::int32_t>(found_.axis.size());
    const std::int32_t first = farthest(some.front()), last = farthest(first);
    found_.axis[chart] = normal_around(first), found_.axis.push_back(normal_around(last));
    for (const std::int32_t t : some) found_.chart[t] = none;
    grow({{first, chart}, {last, other}}, -2);
    Triangles parts[2];
    for (const std::int32_t t : some) parts[found_.chart[t] == other ? 1 : 0].push_back(t);
    if (!parts[0].empty()) found_.axis[chart] = mean_normal(parts[0]);
    if (!parts[1].empty()) found_.axis[other] = mean_normal(parts[1]);
  }

  // Over triangles of its chart.
  [[nodiscard]] std::int32_t farthest(std::int32_t from) {
    Triangles queue{from};
    mark_[from] = ++stamp_;
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (const std::int32_t u : atlas_.at(queue[k]).beyond)
        if (u >= 0 && found_.chart[u] == found_.chart[from] && mark_[u] != stamp_)
          mark_[u] = stamp_, queue.push_back(u);
    return queue.back();
  }

  Triangles region_of(std::int32_t first, std::vector<char>& met) const {
    Triangles region{first};
    met[first] = 1;
    for (std::size_t k = 0; k < region.size(); ++k)
      for (const std::int32_t u : atlas_.at(region[k]).beyond)
        if (u >= 0 && met[u] == 0) met[u] = 1, region.push_back(u);
    return region;
  }

  [[nodiscard]] Vec3 mean_normal(const Triangles& some) const {
    Vec3 sum{0, 0, 0};
    for (const std::int32_t t : some) sum += atlas_.area[t] * atlas_.normal[t];
    const double length = norm(sum);
    return length > 0 ? Vec3(sum / length) : atlas_.normal[some.front()];
  }

  void cut(const Triangles& region) {
    monitor_.checkpoint();
    const auto first = static_cast<std::int32_t>(found_.axis.size());
    const Vec3 mean = mean_normal(region);
    found_.axis.push_back(mean);
    if (std::ranges::all_of(region, [&](std::int32_t t) { return dot(atlas_.normal[t], mean) >= usual_cosine; })) {
      for (const std::int32_t t : region) found_.chart[t] = first;
      return;
    }
    found_.axis.pop_back();
    fill(region, first);
    for (int again = 0; again < regrowths; ++again) regrow(region, first);
  }

  // Places seeds in the middles of the remaining pieces, until no triangle remains.
  void fill(const Triangles& region, std::int32_t first) {
    for (;;) {
      const std::vector<Triangles> pieces = pieces_left(region);
      if (pieces.empty()) return;
      bool joined = false;
      for (const Triangles& piece : pieces)
        if (static_cast<int>(piece.size()) < small_piece && static_cast<std::int32_t>(found_.axis.size()) > first)
          joined = join(piece) || joined;
      if (joined) continue;
      for (const Triangles& piece : pieces) {
        const std::int32_t seed = middle_of(piece);
        const auto chart = static_cast<std::int32_t>(found_.axis.size());
        found_.axis.push_back(normal_around(seed));
        grow({{seed, chart}}, usual_cosine);
      }
    }
  }

  [[nodiscard]] std::vector<Triangles> pieces_left(const Triangles& region) {
    std::vector<Triangles> pieces;
    ++stamp_;
    mark_.resize(atlas_.normal.size(), 0);
    for (const std::int32_t t : region) {
      if (found_.chart[t] != none || mark_[t] == stamp_) continue;
      Triangles& piece = pieces.emplace_back(1, t);
      mark_[t] = stamp_;
      for (std::size_t k = 0; k < piece.size(); ++k)
        for (const std::int32_t u : atlas_.at(piece[k]).beyond)
          if (u >= 0 && found_.chart[u] == none && mark_[u] != stamp_) mark_[u] = stamp_, piece.push_back(u);
    }
    return pieces;
  }

  // To the charts around, as far as they can be shown there.
  bool join(const Triangles& piece) {
    std::vector<Seed> around;
    for (const std::int32_t t : piece)
      for (const std::int32_t u : atlas_.at(t).beyond)
        if (u >= 0 && found_.chart[u] != none) around.push_back({u, found_.chart[u]});
    return grow(around, loose_cosine) > 0;
  }

  // The triangle farthest from the charts around the piece, counted in triangles; the first triangle of a whole region.
  [[nodiscard]] std::int32_t middle_of(const Triangles& piece) {
    Triangles queue;
    ++stamp_;
    for (const std::int32_t t : piece)
      if (std::ranges::any_of(atlas_.at(t).beyond, [&](std::int32_t u) { return u >= 0 && found_.chart[u] != none; }))
        mark_[t] = stamp_, queue.push_back(t);
    if (queue.empty()) return piece.front();
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (const std::int32_t u : atlas_.at(queue[k]).beyond)
        if (u >= 0 && found_.chart[u] == none && mark_[u] != stamp_) mark_[u] = stamp_, queue.push_back(u);
    return queue.back();
  }

  [[nodiscard]] Vec3 normal_around(std::int32_t t) const {
    Triangles around{t};
    for (const std::int32_t u : atlas_.at(t).beyond)
      if (u >= 0) around.push_back(u);
    return mean_normal(around);
  }

  // Grows the charts again from their middles, along their mean normals, and then fills the rest of the region.
  void regrow(const Triangles& region, std::int32_t first) {
    const auto charts = found_.axis.size() - static_cast<std::size_t>(first);
    std::vector<Triangles> members(charts);
    for (const std::int32_t t : region) members[found_.chart[t] - first].push_back(t);
    std::vector<Vec3> axes;
    std::vector<Seed> seeds;
    for (const Triangles& some : members) {
      if (some.empty()) continue;
      const Vec3 axis = mean_normal(some);
      seeds.push_back({most_central(some, axis), first + static_cast<std::int32_t>(axes.size())});
      axes.push_back(axis);
    }
    found_.axis.resize(first);
    found_.axis.insert(found_.axis.end(), axes.begin(), axes.end());
    for (const std::int32_t t : region) found_.chart[t] = none;
    grow(seeds, usual_cosine);
    fill(region, first);
  }

  [[nodiscard]] std::int32_t most_central(const Triangles& some, const Vec3& axis) const {
    Vec3 sum{0, 0, 0};
    double weight = 0;
    for (const std::int32_t t : some) sum += atlas_.area[t] * atlas_.centre[t], weight += atlas_.area[t];
    const Vec3 middle = weight > 0 ? Vec3(sum / weight) : atlas_.centre[some.front()];
    std::int32_t best = some.front();
    double least = infinity;
    for (const std::int32_t t : some) {
      const double far =
          norm(atlas_.centre[t] - middle) + (dot(atlas_.normal[t], axis) < usual_cosine ? 1e3 * norm(middle) : 0);
      if (far < least) least = far, best = t;
    }
    return best;
  }

  /// Triangles that were given to charts: by the shortest ways, which are longer where normals lean.
  std::int64_t grow(const std::vector<Seed>& seeds, double cosine) {
    using Entry = std::tuple<double, std::int32_t, std::int32_t>;  // cost, triangle, chart
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::int64_t given = 0;
    const auto look_around = [&](std::int32_t t, std::int32_t chart, double cost) {
      for (const std::int32_t u : atlas_.at(t).beyond) {
        if (u < 0 || found_.chart[u] != none) continue;
        const double here = lean(u, chart);
        if (here < cosine) continue;
        const double way = norm(atlas_.centre[u] - atlas_.centre[t]) * (1 + price_of_leaning * (1 - here));
        queue.emplace(cost + way, u, chart);
      }
    };
    for (const Seed& s : seeds) {
      if (found_.chart[s.triangle] == none) found_.chart[s.triangle] = s.chart, ++given;
      if (found_.chart[s.triangle] == s.chart) look_around(s.triangle, s.chart, 0);
    }
    while (!queue.empty()) {
      const auto [cost, t, chart] = queue.top();
      queue.pop();
      if (found_.chart[t] != none) continue;
      if (++given % 256 == 0) monitor_.checkpoint();
      found_.chart[t] = chart;
      look_around(t, chart, cost);
    }
    return given;
  }

  const FlatAtlas& atlas_;
  Monitor& monitor_;
  ProjectedCharts found_;
  std::vector<std::int32_t> mark_;
  std::int32_t stamp_ = 0;
};

// Each connected piece of a chart becomes a chart, in the order of their first triangles.
void number_pieces(const FlatAtlas& atlas, ProjectedCharts& charts) {
  std::vector<std::int32_t> piece(charts.chart.size(), none);
  std::vector<Vec3> axes;
  std::vector<std::int32_t> queue;
  for (std::int32_t first = 0; first < atlas.triangles(); ++first) {
    if (piece[first] != none) continue;
    queue.assign(1, first);
    piece[first] = static_cast<std::int32_t>(axes.size());
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (const std::int32_t u : atlas.at(queue[k]).beyond)
        if (u >= 0 && piece[u] == none && charts.chart[u] == charts.chart[first])
          piece[u] = piece[first], queue.push_back(u);
    axes.push_back(charts.axis[charts.chart[first]]);
  }
  charts.chart = std::move(piece), charts.axis = std::move(axes);
}

}  // namespace

bool split_charts(const FlatAtlas& atlas, const std::vector<char>& which, ProjectedCharts& charts, Monitor& monitor) {
  const std::size_t before = charts.axis.size();
  if (std::ranges::count(which, 0) == static_cast<std::ptrdiff_t>(which.size())) return false;
  charts = ChartFinder(atlas, std::move(charts), monitor).split(which);
  return charts.axis.size() > before;
}

bool keep_triangles(const FlatAtlas& atlas, const std::vector<char>& which, ProjectedCharts& charts) {
  bool any = false;
  for (std::int32_t t = 0; t < atlas.triangles(); ++t) {
    if (which[t] == 0 || charts.kept[t] != 0) continue;
    any = true;
    charts.kept[t] = 1, charts.exact[t] = max_exact;
    charts.chart[t] = static_cast<std::int32_t>(charts.axis.size());
    charts.axis.push_back(atlas.normal[t]);
  }
  if (any) number_pieces(atlas, charts);
  return any;
}

ProjectedCharts find_charts(const FlatAtlas& atlas, Monitor& monitor) { return ChartFinder(atlas, monitor).run(); }

}  // namespace carreau
