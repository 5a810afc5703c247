// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/height_blend.h"

#include <algorithm>
#include <set>

#include "geometry/atlas/thresholds.h"

namespace carreau::atlas {
namespace {

/// Charts at most `steps` charts away.
std::vector<std::set<std::int32_t>> charts_around(const Covering& covering, int steps) {
  const std::size_t n = covering.charts().size();
  std::vector<std::set<std::int32_t>> beside(n), reached(n);
  for (const Triple& t : covering.triples())
    for (const std::int32_t c : t.chart) beside[static_cast<std::size_t>(c)].insert(t.chart.begin(), t.chart.end());
  for (std::size_t c = 0; c < n; ++c) {
    reached[c] = {static_cast<std::int32_t>(c)};
    for (int s = 0; s < steps; ++s) {
      std::set<std::int32_t> next;
      for (const std::int32_t d : reached[c]) next.insert(beside[static_cast<std::size_t>(d)].begin(), beside[static_cast<std::size_t>(d)].end());
      reached[c].insert(next.begin(), next.end());
    }
  }
  return reached;
}

}  // namespace

Vec3 HeightBlend::direction(const std::vector<std::int32_t>& charts, std::size_t own, const Vec3& x) const {
  Vec3 sum(0, 0, 0);
  for (const std::int32_t c : charts)
    sum += weight<double>(static_cast<std::size_t>(c), {x.x(), x.y(), x.z()}) * frames_[static_cast<std::size_t>(c)].normal;
  const double length = norm(sum);
  return length > 0 ? Vec3(sum / length) : frames_[own].normal;
}

HeightBlend::HeightBlend(const Covering& covering) {
  const auto vertex = [&](std::int32_t v) -> const Vec3& { return covering.surface().vertices[static_cast<std::size_t>(v)]; };
  for (const Chart& chart : covering.charts()) {
    frames_.push_back(chart.frame);
    heights_.push_back(fine_heights(covering, chart));
    std::vector<Bump> bumps;
    Bump around;
    for (const std::int32_t v : chart.members) {
      double longest = 0;
      for (const std::int32_t w : covering.fans().around(v)) longest = std::max(longest, norm(vertex(w) - vertex(v)));
      bumps.push_back({vertex(v), thresholds::bump_radius * longest});
      around.centre += vertex(v) / static_cast<double>(chart.members.size());
    }
    for (const Bump& bump : bumps) around.radius = std::max(around.radius, norm(bump.centre - around.centre) + bump.radius);
    bumps_.push_back(std::move(bumps));
    around_.push_back(around);
  }
  const std::vector<std::set<std::int32_t>> near = charts_around(covering, thresholds::charts_away);
  for (const auto& of_chart : near) near_chart_.emplace_back(of_chart.begin(), of_chart.end());
  for (const Triple& t : covering.triples()) {
    std::set<std::int32_t> all;
    for (const std::int32_t c : t.chart) all.insert(near[static_cast<std::size_t>(c)].begin(), near[static_cast<std::size_t>(c)].end());
    near_triple_.emplace_back(all.begin(), all.end());
  }
}

}  // namespace carreau::atlas
