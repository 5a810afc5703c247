// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "measure/mesh_evaluation.h"
#include "metric/unit_edge.h"
#include "support/format.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "support/shares.h"
#include "support/short_number.h"

namespace carreau {

namespace {

// Powers of ten from below the smallest positive value, at most six of them, to above the largest.
std::vector<double> decades(std::span<const double> values) {
  double low = infinity, high = 0;
  for (const double x : values) {
    if (!(x > 0) || x == infinity) continue;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  std::vector<double> bounds;
  if (high == 0) return bounds;
  const int last = static_cast<int>(std::ceil(std::log10(high)));
  const int first = std::max(last - 6, static_cast<int>(std::floor(std::log10(low))));
  for (int k = first; k <= last; ++k) bounds.push_back(std::pow(10.0, k));
  return bounds;
}

std::string percent(std::int64_t part, std::int64_t all) {
  return format_number(all == 0 ? 0 : std::round(1e4 * static_cast<double>(part) / static_cast<double>(all)) / 100) +
         " %";
}

std::string line_of(const char* name, const Spread& spread) {
  std::string text = std::string(name) + ": mean " + short_number(spread.mean) + ", " + short_number(spread.min) +
                     " to " + short_number(spread.max) + " (1 % below " + short_number(spread.p1) + ", 1 % above " +
                     short_number(spread.p99) + ")";
  std::string classes;
  const Histogram& h = spread.histogram;
  for (std::size_t i = 0; i < h.count.size(); ++i) {
    if (h.count[i] == 0 || h.count.size() == 1) continue;  // one class has no bounds
    classes += classes.empty() ? ";" : ",";
    if (i == 0)
      classes += " below " + short_number(h.bound[1]);
    else if (i + 1 == h.count.size())
      classes += " from " + short_number(h.bound[i]);
    else
      classes += " " + short_number(h.bound[i]) + " to " + short_number(h.bound[i + 1]);
    classes += ": " + std::to_string(h.count[i]);
  }
  return text + classes;
}

/// "3 of 100 edges (3 %) have"
std::string part_of(std::int64_t part, std::int64_t all, const char* entities) {
  return std::to_string(part) + " of " + std::to_string(all) + " " + entities + " (" + percent(part, all) + ") have";
}

std::int64_t count_above(const std::vector<double>& values, double limit) {
  return std::count_if(values.begin(), values.end(), [&](double x) { return x > limit * (1 + rounding_of::places); });
}

}  // namespace

Spread spread_of(std::span<const double> values, std::span<const double> inner) {
  Spread spread;
  std::vector<double> known;
  known.reserve(values.size());
  for (const double x : values)
    if (!std::isnan(x)) known.push_back(x);
  std::vector<double>& bound = spread.histogram.bound;
  bound.push_back(-infinity);
  bound.insert(bound.end(), inner.begin(), inner.end());
  bound.push_back(infinity);
  spread.histogram.count.assign(bound.size() - 1, 0);
  spread.count = static_cast<std::int64_t>(known.size());
  if (known.empty()) return spread;
  double sum = 0;
  for (const double x : known) {
    sum += x;
    const auto above = std::upper_bound(inner.begin(), inner.end(), x);
    ++spread.histogram.count[static_cast<std::size_t>(above - inner.begin())];
  }
  spread.mean = sum / static_cast<double>(known.size());
  const auto rank = [&](std::size_t k) {
    const auto place = known.begin() + static_cast<std::ptrdiff_t>(k);
    std::nth_element(known.begin(), place, known.end());
    return *place;
  };
  const std::size_t last = known.size() - 1;
  spread.p1 = rank(known.size() / 100);
  spread.p99 = rank(last - known.size() / 100);
  const auto [low, high] = std::minmax_element(known.begin(), known.end());
  spread.min = *low;
  spread.max = *high;
  return spread;
}

std::span<const EvaluatedMeasure> delivered_measures() {
  using Kind = EvaluationKind;
  using Entity = EvaluationEntity;
  static constexpr std::array<EvaluatedMeasure, evaluation_kinds> table{{
      {Kind::length, Entity::edge, "metric_length", "metric length of edges"},
      {Kind::edge_angle, Entity::edge, "edge_angle", "angle of edges with tangent planes, degrees"},
      {Kind::gradation, Entity::edge, "gradation", "gradation of sizes along edges"},
      {Kind::length_ratio, Entity::vertex, "length_ratio", "longest over shortest edge of a vertex"},
      {Kind::q1, Entity::triangle, "Q1", "shape Q1"},
      {Kind::q2, Entity::triangle, "Q2", "shape Q2"},
      {Kind::metric_quality, Entity::triangle, "metric_quality", "shape Q2 in the metric"},
      {Kind::deviation, Entity::triangle, "A0", "deviation A0, model length"},
      {Kind::angle, Entity::triangle, "A1", "deviation A1, degrees"},
      {Kind::curve_deviation, Entity::edge, "curve_A0", "deviation A0 of edges from their curves, model length"},
      {Kind::curve_angle, Entity::edge, "curve_A1", "deviation A1 of edges from their curves, degrees"},
      {Kind::vertex_angle, Entity::triangle, "vertex_angle", "angle of triangles with tangent planes at their vertices, degrees"},
      {Kind::deviation_bound, Entity::triangle, "A0_bound", "upper bound of A0, model length"},
      {Kind::angle_bound, Entity::triangle, "A1_bound", "upper bound of A1, degrees"},
      {Kind::bound_share, Entity::triangle, "bound_share", "upper bounds of A0 and A1 over their tolerances"},
      {Kind::input_bound, Entity::triangle, "input_bound", "upper bound of the distance to the given triangles, model length"},
  }};
  return table;
}

void summarise(MeshEvaluation& d) {
  static constexpr std::array lengths{0.25, 0.5, unit_edge::shortest, 0.9, 1.1, unit_edge::longest, 2.0, 4.0};
  static constexpr std::array shares{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  static constexpr std::array angles{1.0, 2.0, 4.0, 8.0, 10.0, 16.0, 30.0, 60.0, 90.0};
  static constexpr std::array ratios{1.1, 1.2, 1.3, 1.5, 2.0, 3.0, 5.0};
  for (const EvaluatedMeasure& measure : delivered_measures()) {
    Delivery& one = d[measure.kind];
    std::span<const double> bounds = shares;
    std::vector<double> powers;
    switch (measure.kind) {
      case EvaluationKind::length:
        bounds = lengths;
        break;
      case EvaluationKind::edge_angle:
      case EvaluationKind::angle:
      case EvaluationKind::curve_angle:
      case EvaluationKind::vertex_angle:
      case EvaluationKind::angle_bound:
        bounds = angles;
        break;
      case EvaluationKind::gradation:
      case EvaluationKind::length_ratio:
        bounds = ratios;
        break;
      case EvaluationKind::deviation:
      case EvaluationKind::curve_deviation:
      case EvaluationKind::deviation_bound:
      case EvaluationKind::input_bound:
        powers = decades(one.values);
        bounds = powers;
        break;
      default:
        break;
    }
    one.spread = spread_of(one.values, bounds);
    one.tolerance = measure.kind == EvaluationKind::gradation ? shares::of_polylines : rounding_of::places;
    one.beyond = std::count_if(one.values.begin(), one.values.end(), [&one](double x) { return one.exceeds(x); });
  }
  const std::vector<double>& length = d[EvaluationKind::length].values;
  d.long_edges = count_above(length, unit_edge::longest);
  d.short_edges =
      std::count_if(length.begin(), length.end(), [](double l) { return l < unit_edge::shortest / (1 + rounding_of::places); });
  d.folded_triangles = count_above(d[EvaluationKind::angle].values, 90);
}

double MeshEvaluation::share_in_range() const noexcept {
  const Delivery& length = (*this)[EvaluationKind::length];
  // Diagonals of quadrilaterals have none.
  const auto measured = std::count_if(length.values.begin(), length.values.end(), [](double l) { return l == l; });
  return measured == 0 ? 0 : 1 - static_cast<double>(short_edges + long_edges) / static_cast<double>(measured);
}

std::vector<BeyondInFace> beyond_in_faces(const SurfaceMesh& mesh, const MeshEvaluation& delivered) {
  const Delivery& share = delivered[EvaluationKind::bound_share];
  std::map<int, BeyondInFace> of_face;  // by reference
  if (share.values.size() != mesh.triangle_count()) return {};
  std::size_t t = 0;
  for (const FaceMesh& face : mesh.faces)
    for (std::size_t k = 0; k < face.triangles.size(); ++k, ++t) {
      if (!share.exceeds(share.values[t])) continue;
      BeyondInFace& here = of_face[face.shown_ref()];
      here.ref = face.shown_ref(), ++here.triangles, here.worst = std::max(here.worst, share.values[t]);
    }
  std::vector<BeyondInFace> all;
  for (const auto& [ref, here] : of_face) all.push_back(here);
  std::ranges::stable_sort(all, std::greater<>(), &BeyondInFace::worst);
  return all;
}

// The worst ones.
std::string describe(const std::vector<BeyondInFace>& beyond) {
  constexpr std::size_t most = 5;
  std::string text;
  for (std::size_t k = 0; k < std::min(most, beyond.size()); ++k)
    text += (k == 0 ? "triangles beyond their tolerances: " : "; ") + std::to_string(beyond[k].triangles) + " of face " +
            std::to_string(beyond[k].ref) + ", up to " + short_number(beyond[k].worst) + " times them";
  if (beyond.size() > most) text += "; and some of " + std::to_string(beyond.size() - most) + " other faces";
  return text;
}

DeliveredText describe(const MeshEvaluation& d) {
  DeliveredText text;
  for (const EvaluatedMeasure& measure : delivered_measures())
    if (measure.kind < EvaluationKind::deviation_bound || d[measure.kind].spread.count > 0)
      text.summary.push_back(line_of(measure.title, d[measure.kind].spread));
  if (const InputDistances& input = d.input; input.bound == input.bound)
    text.summary.push_back("distance to the given triangles: " + short_number(input.distance) + " to " +
                           short_number(input.bound) + " at most, " + short_number(input.back_distance) + " to " +
                           short_number(input.back_bound) + " back");
  const auto edges = static_cast<std::int64_t>(d.edges.vertices.size());
  if (const std::int64_t n = d.short_edges + d.long_edges; n > 0)
    text.not_met.push_back(part_of(n, edges, "edges") + " metric lengths outside [0.7071, 1.414]: " +
                           std::to_string(d.short_edges) + " are shorter, " + std::to_string(d.long_edges) + " longer");
  const auto check = [&](EvaluationKind kind, const char* entities, const char* rule) {
    const Delivery& one = d[kind];
    if (one.beyond == 0) return;
    std::string said = part_of(one.beyond, one.spread.count, entities) + " " + rule +
                       " more than the " + short_number(one.limit) + " prescribed; the worst has " +
                       short_number(one.spread.max);
    if (one.forced > 0)
      said += "; " + std::to_string(one.forced) +
              (kind == EvaluationKind::gradation
                   ? std::string(" of them cross a face from curve to curve")
                   : " of them are as short as hgeomin lets edges be (" + short_number(one.shortest) + ")");
    text.not_met.push_back(std::move(said));
  };
  check(EvaluationKind::edge_angle, "edges", "an angle with a tangent plane at their ends of");
  check(EvaluationKind::gradation, "edges", "a gradation of sizes of");
  check(EvaluationKind::length_ratio, "vertices", "a ratio of the lengths of their edges of");
  check(EvaluationKind::deviation, "triangles", "a distance from the surface of");
  check(EvaluationKind::curve_angle, "edges of curves", "an angle with a tangent of their curve of");
  check(EvaluationKind::curve_deviation, "edges of curves", "a distance from their curve of");
  check(EvaluationKind::vertex_angle, "triangles", "an angle with a tangent plane at their vertices of");
  if (const Delivery& share = d[EvaluationKind::bound_share]; share.beyond > 0)
    text.not_met.push_back(part_of(share.beyond, share.spread.count, "triangles") +
                           " an upper bound of their distance from the surface or of their angle with it beyond the tolerance; the worst has " +
                           short_number(share.spread.max) + " times it");
  if (d.folded_triangles > 0)
    text.not_met.push_back(
        part_of(d.folded_triangles, static_cast<std::int64_t>(d.edges.of_triangle.size()), "triangles") +
        " a normal turned by more than 90 degrees against the surface");
  return text;
}

}  // namespace carreau
