// SPDX-License-Identifier: BSD-3-Clause
// The search around the worst cells.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/local_search.h"
#include "metric/unit_edge.h"
#include "surface/elements/quads/quad_patch.h"
#include "surface/elements/quads/thresholds.h"

namespace carreau {

/// Vertices around the worst cells. Quads: PlaneQuads, SpaceQuads, or a face on its surface (space_search).
template <typename Quads>
class WorstQuads {
 public:
  WorstQuads(Quads& quads, double good, Monitor& monitor)
      : quads_(quads),
        good_(good),
        monitor_(monitor),
        quality_(quads.cells().size(), 0),
        stale_(quads.cells().size(), 1),
        in_vain_(quads.vertices(), 0) {}

  void run() {
    improve_in_passes(
        thresholds::quads::worst_passes, monitor_, [this] { return corners_of_bad(); }, [this](std::int32_t v) { return improve(v); });
  }

 private:
  std::vector<std::int32_t> corners_of_bad() {
    std::vector<std::pair<double, std::int32_t>> bad;
    const std::vector<MixedCell>& cells = quads_.cells();
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (stale_[c] != 0) quality_[c] = quads_.untangling_quality(quads_.about(cells[c]), cells[c]);
      stale_[c] = 0;
      if (quality_[c] < good_) bad.emplace_back(quality_[c], static_cast<std::int32_t>(c));
    }
    std::sort(bad.begin(), bad.end());
    std::vector<std::int32_t> corners;
    for (const auto& [q, c] : bad)
      for (int k = 0; k < corners_of(cells[c]); ++k)
        if (!quads_.is_fixed(cells[c][k])) corners.push_back(cells[c][k]);
    return corners;
  }

  // Below `enough` the exact value does not matter; all values beyond good_ count as equal.
  double worst_around(double enough) const {
    double worst = good_;
    for (const auto& [c, frame] : star_) {
      worst = std::min(worst, quads_.untangling_quality(frame, quads_.cells()[c]));
      if (worst < enough) break;
    }
    return worst;
  }

  bool improve(std::int32_t v) {
    if (in_vain_[v] != 0) return false;
    in_vain_[v] = 1;
    star_.clear();
    if (!around_) around_ = cells_around(quads_.vertices(), quads_.cells());
    for (const std::int32_t c : around_->of(v)) star_.emplace_back(c, quads_.about(quads_.cells()[c]));
    const double start = worst_around(-2);
    if (start >= good_) return false;
    const typename Quads::Place home = quads_.place(v);
    const typename Quads::Frame frame = quads_.about(v);
    const Vec2 way = search_along_compass(start, unit_edge::first_step, unit_edge::last_step, [&](const Vec2& there, double best) {
      quads_.try_at(v, home, Quads::way(frame, there));
      return worst_around(best);
    });
    if (way == Vec2{0, 0}) {
      quads_.put(v, home);
      return false;
    }
    quads_.try_at(v, home, Quads::way(frame, way));
    if constexpr (!Quads::on_surface) {
      if (!quads_.settle(v, home) || !(worst_around(-2) > start)) {
        quads_.put(v, home);
        return false;
      }
    }
    for (const std::int32_t c : around_->of(v)) {
      stale_[c] = 1;
      for (int k = 0; k < corners_of(quads_.cells()[c]); ++k) in_vain_[quads_.cells()[c][k]] = 0;
    }
    return true;
  }

  Quads& quads_;
  double good_;
  Monitor& monitor_;
  std::optional<Incidence> around_;
  std::vector<double> quality_;  // by cell, unless
  std::vector<char> stale_;      // its vertices have moved since
  std::vector<char> in_vain_;    // by vertex: nothing around has moved since a search
  std::vector<std::pair<std::int32_t, typename Quads::Frame>> star_;  // cells around the vertex at hand, with frames that stay
};

}  // namespace carreau
