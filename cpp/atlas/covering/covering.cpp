// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/covering/covering.h"

#include <algorithm>
#include <map>

#include "atlas/covering/ring_chart.h"
#include "atlas/covering/ring_phi.h"
#include "atlas/covering/thresholds.h"
#include "support/error.h"
#include "support/rounding_of.h"

namespace carreau::atlas {
namespace {

/// The corners of a triangle, the smallest vertex first.
std::array<std::int32_t, 3> key_of(std::int32_t a, std::int32_t b, std::int32_t c) {
  std::array<std::int32_t, 3> key{a, b, c};
  std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
  return key;
}

std::string first_of(const std::vector<std::string>& list) {
  const auto found = std::find_if(list.begin(), list.end(), [](const std::string& s) { return !s.empty(); });
  return found == list.end() ? "" : *found;
}

}  // namespace

Covering::Covering(const Triangulation& surface, const CoveringOptions& options) : surface_(surface), fans_(surface) {
  if (options.hops < 1)
    throw InvalidArgument("clusters of an atlas reach " + std::to_string(options.hops) +
                          " edges; they must reach 1 or more");
  std::string why;
  for (int level = 0; level <= thresholds::subdivisions; ++level) {
    if (level > 0) surface_ = subdivided(surface_), fans_ = Fans(surface_);
    Partition partition = grown_clusters(surface_, fans_, options.hops);
    const std::vector<std::string> before = defects(surface_, fans_, partition);
    const auto sound = std::count(before.begin(), before.end(), "");
    if (static_cast<double>(sound) >= thresholds::repairable * static_cast<double>(before.size()))
      repair_clusters(surface_, fans_, partition);
    why = first_of(defects(surface_, fans_, partition));
    if (!why.empty()) continue;
    build(partition, options);
    return;
  }
  throw DomainError("no clusters of the triangulation make an atlas, although its triangles were divided " +
                    std::to_string(thresholds::subdivisions) + " times: " + why);
}

Covering::Covering(const Triangulation& surface, const Partition& partition, const CoveringOptions& options)
    : surface_(surface), fans_(surface) {
  if (partition.size() != surface.vertices.size())
    throw InvalidArgument("there are clusters of " + std::to_string(partition.size()) +
                          " vertices for a triangulation of " + std::to_string(surface.vertices.size()));
  const std::string why = first_of(defects(surface_, fans_, partition));
  if (!why.empty()) throw DomainError(why);
  build(partition, options);
}

void Covering::build(const Partition& partition, const CoveringOptions& options) {
  std::map<std::array<std::int32_t, 3>, std::int32_t> number;
  const auto members = members_of(partition);
  for (std::size_t i = 0; i < members.size(); ++i) {
    std::string defect;
    Ring ring = ring_of(fans_, partition, members[i], defect);
    const Frame frame = frame_of(surface_, fans_, members[i]);
    std::vector<Corner> corners;
    for (std::size_t k = 0; k < ring.triples.size(); ++k) {
      const Spoke &s = ring.spokes[ring.triples[k]], &t = ring.spokes[(ring.triples[k] + 1) % ring.spokes.size()];
      const auto key = key_of(s.inner, s.outer, t.outer);
      const auto [at, is_new] = number.try_emplace(key, static_cast<std::int32_t>(triples_.size()));
      if (is_new) triples_.emplace_back();
      const int corner = static_cast<int>(std::find(key.begin(), key.end(), s.inner) - key.begin());
      Triple& triple = triples_[static_cast<std::size_t>(at->second)];
      triple.chart[static_cast<std::size_t>(corner)] = static_cast<std::int32_t>(i);
      triple.slot[static_cast<std::size_t>(corner)] = static_cast<std::int32_t>(k);
      corners.push_back({at->second, corner});
    }
    set_phi(surface_, ring);
    RingChart chart = chart_of_ring(surface_, frame, ring);
    AnnulusOptions annulus{.border = options.border,
                           .outer_first = options.outer_first,
                           .star = true,
                           .phi = std::move(chart.phi),
                           .period = sixth_turn * static_cast<double>(corners.size())};
    charts_.push_back({frame, Annulus(std::move(chart.inner), std::move(chart.outer), std::move(annulus)),
                       std::move(corners), members[i], ring.outer_border});
  }
}

Zone Covering::zone(std::size_t chart, const Vec2& m) const {
  const Annulus& annulus = charts_[chart].annulus;
  if (annulus.find(pair_of(m))) return Zone::shared;
  return annulus.encloses(m) ? Zone::pure : Zone::outside;
}

std::optional<Vec2> Covering::transition(std::size_t i, std::size_t j, const Vec2& m) const {
  if (i == j) return m;
  const auto on = on_t(i, pair_of(m));
  if (!on) return {};
  const Triple& t = triples_[static_cast<std::size_t>(on->corner.triple)];
  for (int c = 0; c < 3; ++c) {
    if (static_cast<std::size_t>(t.chart[static_cast<std::size_t>(c)]) != j || c == on->corner.corner) continue;
    const double share = share_of(to_polar(c, on->place));
    if (share < -rounding_of::places || share > 1 + rounding_of::places) continue;
    return value_of(from_t(on->corner.triple, c, on->place));
  }
  return {};
}

double Covering::weight(std::size_t chart, const Vec2& m) const {
  const auto on = on_t(chart, pair_of(m));
  if (on) return weights(on->place)[static_cast<std::size_t>(on->corner.corner)];
  return charts_[chart].annulus.encloses(m) ? 1 : 0;
}

}  // namespace carreau::atlas
