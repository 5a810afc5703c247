// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <utility>

#include "surface/remesh/planes/find_charts.h"
#include "surface/remesh/planes/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::planes;

class ChartMerger {
 public:
  ChartMerger(const FlatAtlas& atlas, ProjectedCharts& charts, double cosine, Monitor& monitor)
      : atlas_(atlas),
        charts_(charts),
        cosine_(cosine),
        monitor_(monitor),
        members_(charts.axis.size()),
        sum_(charts.axis.size()),
        area_(charts.axis.size()) {
    for (std::int32_t t = 0; t < atlas.triangles(); ++t) add(charts.chart[t], t);
  }

  void run(const std::vector<char>& which, bool again) {
    std::vector<std::pair<double, std::int32_t>> queue;  // the smallest ones at the end
    for (std::size_t c = 0; c < members_.size(); ++c)
      if (which[c] != 0) queue.emplace_back(area_[c], static_cast<std::int32_t>(c));
    std::ranges::sort(queue, std::greater<>());
    while (!queue.empty()) {
      monitor_.checkpoint();
      const auto [area, chart] = queue.back();
      queue.pop_back();
      if (members_[chart].empty() || area != area_[chart]) continue;
      const std::int32_t into = best_neighbour(chart);
      if (into < 0) continue;
      for (const std::int32_t t : std::exchange(members_[chart], {})) add(into, t);
      charts_.axis[into] = sum_[into] / norm(sum_[into]);
      if (again)
        queue.insert(std::ranges::upper_bound(queue, std::pair{area_[into], into}, std::greater<>()),
                     {area_[into], into});
    }
    number();
  }

 private:
  void add(std::int32_t chart, std::int32_t t) {
    charts_.chart[t] = chart;
    members_[chart].push_back(t);
    sum_[chart] += atlas_.area[t] * atlas_.normal[t];
    area_[chart] += atlas_.area[t];
  }

  // Returns the neighbour with the longest common border that one axis can show together with the chart; -1: no such
  // neighbour.
  [[nodiscard]] std::int32_t best_neighbour(std::int32_t chart) const {
    std::map<std::int32_t, double> border;
    for (const std::int32_t t : members_[chart])
      for (int i = 0; i < 3; ++i) {
        const Charts::Triangle& here = atlas_.at(t);
        const std::int32_t u = here.beyond[i];
        if (u < 0 || charts_.chart[u] == chart) continue;
        border[charts_.chart[u]] += norm(atlas_.xyz(here.vertex[(i + 1) % 3]) - atlas_.xyz(here.vertex[i]));
      }
    std::vector<std::pair<double, std::int32_t>> by_length;
    for (const auto& [other, length] : border) by_length.emplace_back(-length, other);
    std::ranges::sort(by_length);
    for (const auto& [length, other] : by_length)
      if (fits(chart, other)) return other;
    return -1;
  }

  [[nodiscard]] bool is_kept(std::int32_t chart) const {
    return !charts_.kept.empty() && charts_.kept[members_[chart].front()] != 0;
  }

  [[nodiscard]] bool fits(std::int32_t p, std::int32_t q) const {
    if (is_kept(p) || is_kept(q)) return false;
    const Vec3 sum = sum_[p] + sum_[q];
    // The surface leans more than its flat triangles: at their corners the projection must not turn over.
    const double least = cosine_ * norm(sum), min_at_corners = min_cosine * norm(sum);
    const auto shown = [&](std::int32_t t) {
      return dot(atlas_.normal[t], sum) >= least &&
             std::ranges::all_of(atlas_.corner[t], [&](const Vec3& n) { return dot(n, sum) >= min_at_corners; });
    };
    return least > 0 && std::ranges::all_of(members_[p], shown) && std::ranges::all_of(members_[q], shown);
  }

  // Without gaps.
  void number() {
    std::vector<std::int32_t> rank(members_.size(), -1);
    std::vector<Vec3> axes;
    for (std::size_t c = 0; c < members_.size(); ++c)
      if (!members_[c].empty()) {
        rank[c] = static_cast<std::int32_t>(axes.size());
        axes.push_back(charts_.axis[c]);
      }
    for (std::int32_t& c : charts_.chart) c = rank[c];
    charts_.axis = std::move(axes);
  }

  const FlatAtlas& atlas_;
  ProjectedCharts& charts_;
  double cosine_;
  Monitor& monitor_;
  std::vector<std::vector<std::int32_t>> members_;
  std::vector<Vec3> sum_;  // of normals by area
  std::vector<double> area_;
};

}  // namespace

void merge_charts(const FlatAtlas& atlas, double cosine, std::vector<char> which, ProjectedCharts& charts,
                  Monitor& monitor) {
  const bool all = which.empty();
  if (all) which.assign(charts.axis.size(), 1);
  ChartMerger(atlas, charts, cosine, monitor).run(which, all);
}

}  // namespace carreau
