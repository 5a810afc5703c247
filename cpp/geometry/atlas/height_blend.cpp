// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/height_blend.h"

#include <algorithm>
#include <set>

#include "geometry/atlas/thresholds.h"

namespace carreau::atlas {

Vec3 HeightBlend::direction(const std::vector<std::int32_t>& vertices, const Vec3& x) const {
  Vec3 sum(0, 0, 0);
  const std::array<double, 3> at{x.x(), x.y(), x.z()};
  visit(vertices, at,
        [&](const LocalHeights& local, const auto&, double weight) { sum += weight * local.frame.normal; });
  const double length = norm(sum);
  return length > 0 ? Vec3(sum / length) : around_[nearest(vertices, x)].frame.normal;
}

std::size_t HeightBlend::nearest(const std::vector<std::int32_t>& vertices, const Vec3& x) const {
  const auto distance = [&](std::int32_t v) {
    return (around_[static_cast<std::size_t>(v)].frame.origin - x).squaredNorm();
  };
  const auto best = std::min_element(vertices.begin(), vertices.end(),
                                     [&](std::int32_t a, std::int32_t b) { return distance(a) < distance(b); });
  return static_cast<std::size_t>(*best);
}

HeightBlend::HeightBlend(const Covering& covering) {
  for (std::size_t v = 0; v < covering.surface().vertices.size(); ++v)
    around_.push_back(local_heights(covering, static_cast<std::int32_t>(v)));
  const auto grown = [&](std::set<std::int32_t> region) {
    for (int ring = 0; ring < thresholds::rings_away; ++ring) {
      const std::vector<std::int32_t> inside(region.begin(), region.end());
      for (const std::int32_t v : inside)
        region.insert(covering.fans().around(v).begin(), covering.fans().around(v).end());
    }
    return region;
  };
  std::vector<std::set<std::int32_t>> near;
  for (const Chart& chart : covering.charts()) {
    std::set<std::int32_t> region(chart.members.begin(), chart.members.end());
    region.insert(chart.around.begin(), chart.around.end());
    near.push_back(grown(std::move(region)));
    near_chart_.emplace_back(near.back().begin(), near.back().end());
  }
  for (const Triple& t : covering.triples()) {
    std::set<std::int32_t> all;
    for (const std::int32_t c : t.chart)
      all.insert(near[static_cast<std::size_t>(c)].begin(), near[static_cast<std::size_t>(c)].end());
    near_triple_.emplace_back(all.begin(), all.end());
  }
}

}  // namespace carreau::atlas
