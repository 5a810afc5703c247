// SPDX-License-Identifier: BSD-3-Clause
#include "surface/grade/size_grading.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "curve/unit_discretisation.h"
#include "periodic/shared_curves.h"
#include "support/rounding_of.h"
#include "support/shares.h"
#include "support/work_bounds.h"
#include "surface/grade/graph_sizes.h"
#include "surface/grade/thresholds.h"

namespace carreau {

namespace detail {

using namespace thresholds::grade;

void widen_rough(GradedFace& face) {
  std::vector<char> beside(face.uv.size(), 0);
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    if (face.smooth[t] == 0)
      for (const std::int32_t v : face.triangles[t]) beside[v] = 1;
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    for (const std::int32_t v : face.triangles[t])
      if (beside[v] != 0) face.smooth[t] = 0;
}

namespace {

/// A graph whose sizes are graded.
struct Round {
  GradedModel graded;
  std::size_t long_edges = 0;  ///< of the graph, for the graded sizes
};

std::size_t count_long_edges(const GradationGraph& graph, const GraphSizes& sizes) {
  std::size_t count = 0;
  for (const auto& t : graph.triangles)
    for (int i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      const Vec3 e = graph.xyz[graph.places[b].vertex] - graph.xyz[graph.places[a].vertex];
      count += normalised_length(SizeLaw::linear, sizes.along(a, unit(e)), sizes.along(b, unit(e)), norm(e)) > too_long;
    }
  return count;
}

// Places where the sizes of a curve are sampled inside an edge of the graph: at equal distances and at known places.
std::vector<double> between(double from, double to, const std::vector<double>& known) {
  std::vector<double> at;
  for (int i = 1; i < samples_per_edge; ++i)
    at.push_back(std::lerp(from, to, static_cast<double>(i) / samples_per_edge));
  const double least = rounding_of::sizes * (to - from);
  for (const double r : known)
    if (r > from + least && r < to - least) at.push_back(r);
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end(), [least](double p, double q) { return q - p < least; }), at.end());
  return at;
}

// Sizes along a curve, between the graded ones at its vertices in the graph.
SizeSamples graded_along(const DiscreteCurve& d, std::size_t c, const SizeSamples& raw, const GraphSizes& sizes,
                         const GradedField& field) {
  SizeSamples result;
  const auto add = [&](double r, double size) {
    result.r.push_back(r);
    result.h.push_back(size);
    result.physical.push_back(raw.physical_at(r));
  };
  std::vector<double> h;
  for (std::size_t k = 0; k < d.r.size(); ++k) h.push_back(sizes.at_node(c, k, raw));
  for (std::size_t k = 0; k + 1 < d.r.size(); ++k) {
    add(d.r[k], h[k]);
    if (d.indivisible) continue;
    for (const double r : between(d.r[k], d.r[k + 1], raw.r)) {
      const double w = (r - d.r[k]) / (d.r[k + 1] - d.r[k]);
      add(r, sizes.between_nodes(c, k, w, std::lerp(h[k], h[k + 1], w), raw.size_at(r), field));
    }
  }
  add(d.r.back(), h.back());
  return result;
}

Round grade(GradingWork& work, const std::vector<SizeSamples>& raw) {
  const double slope = slope_of_gradation(work.options.gradation);
  GraphSizes& sizes = *work.sizes;
  sizes.grade(raw, slope);
  Round round;
  round.long_edges = count_long_edges(work.graph, sizes);
  for (std::size_t f = 0; f < work.faces.size(); ++f) sizes.give_to_face(f);
  round.graded.triangles = work.graph.triangles.size();
  round.graded.field = std::make_shared<GradedField>(slope, std::move(work.faces));
  for (std::size_t c = 0; c < raw.size(); ++c)
    round.graded.curves.push_back(graded_along(work.curves[c], c, raw[c], sizes, *round.graded.field));
  round.graded.missed = std::move(work.missed);
  return round;
}

Round run_round(GradingWork& work, const std::vector<SizeSamples>& raw, const GradedModel& before) {
  make_graph(work, raw, before);
  if (work.options.proximity > 0) {
    bound_narrow_zones(work);
    bound_facing_faces(work);
  }
  return grade(work, raw);
}

}  // namespace

}  // namespace detail

GradedModel grade_model(const CurveModel& model, SizeRules& rules, const CompositeOptions& options, double diag,
                        Monitor& monitor, const PeriodicModel& periodic) {
  using namespace thresholds::grade;
  std::vector<SizeSamples> raw;
  for (std::size_t c = 0; c < model.topology.curves.size(); ++c) {
    monitor.checkpoint();
    raw.push_back(sample_sizes(model, static_cast<int>(c), rules, {.lss = options.lss}));
  }
  share_sizes(periodic, model, raw);
  GradedModel graded;
  std::size_t long_before = SIZE_MAX;
  double triangles_before = 0;
  for (int number = 1; number <= work_bounds::rounds; ++number) {
    detail::GradingWork work(model, rules, options, diag, monitor, periodic);
    auto [now, long_edges] = detail::run_round(work, raw, graded);
    graded = std::move(now);
    graded.rounds = number;
    if (long_edges == 0) break;
    // Long edges of a pole stay, and a few others change nothing.
    const double change = static_cast<double>(graded.triangles) / std::max(triangles_before, 1.) - 1;
    const bool few = static_cast<double>(long_edges) < shares::small * static_cast<double>(graded.triangles);
    if ((number > 1 && few) || (std::abs(change) < shares::notable && 2 * long_edges > long_before)) break;
    long_before = long_edges;
    triangles_before = static_cast<double>(graded.triangles);
  }
  return graded;
}

}  // namespace carreau
