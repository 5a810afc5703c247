#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/format.h"
#include "surface/delivered.h"

namespace carreau {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double short_limit = std::numbers::sqrt2 / 2, long_limit = std::numbers::sqrt2;

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

std::string short_text(double x) {
  if (x == 0 || !std::isfinite(x)) return format_number(x);
  // Four significant digits.
  const double scale = std::pow(10.0, 3 - std::floor(std::log10(std::abs(x))));
  return format_number(std::round(x * scale) / scale);
}

std::string percent(std::int64_t part, std::int64_t all) {
  return format_number(all == 0 ? 0 : std::round(1e4 * static_cast<double>(part) / static_cast<double>(all)) / 100) +
         " %";
}

std::string line_of(const char* name, const Spread& spread) {
  std::string text = std::string(name) + ": mean " + short_text(spread.mean) + ", " + short_text(spread.min) + " to " +
                     short_text(spread.max) + " (1 % below " + short_text(spread.p1) + ", 1 % above " +
                     short_text(spread.p99) + ")";
  std::string classes;
  const Histogram& h = spread.histogram;
  for (std::size_t i = 0; i < h.count.size(); ++i) {
    if (h.count[i] == 0) continue;
    classes += classes.empty() ? ";" : ",";
    if (i == 0)
      classes += " below " + short_text(h.bound[1]);
    else if (i + 1 == h.count.size())
      classes += " from " + short_text(h.bound[i]);
    else
      classes += " " + short_text(h.bound[i]) + " to " + short_text(h.bound[i + 1]);
    classes += ": " + std::to_string(h.count[i]);
  }
  return text + classes;
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

void summarise(Delivered& d) {
  const std::vector<double> lengths{0.25, 0.5, short_limit, 0.9, 1.1, long_limit, 2, 4};
  const std::vector<double> shares{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  const std::vector<double> angles{1, 2, 4, 8, 10, 16, 30, 60, 90};
  const std::vector<double> ratios{1.1, 1.2, 1.3, 1.5, 2, 3, 5};
  d.length = spread_of(d.edges.length, lengths);
  d.edge_angle = spread_of(d.edges.angle, angles);
  d.gradation = spread_of(d.edges.gradation, ratios);
  d.q1 = spread_of(d.triangles.q1, shares);
  d.q2 = spread_of(d.triangles.q2, shares);
  d.metric_quality = spread_of(d.triangles.metric_quality, shares);
  d.deviation = spread_of(d.triangles.deviation, decades(d.triangles.deviation));
  d.angle = spread_of(d.triangles.angle, angles);
}

double Delivered::share_in_range() const noexcept {
  return length.count == 0
             ? 0
             : 1 - static_cast<double>(short_edges + long_edges) / static_cast<double>(edges.length.size());
}

DeliveredText describe(const Delivered& d) {
  DeliveredText text;
  text.summary = {line_of("metric length of edges", d.length),
                  line_of("gradation along edges", d.gradation),
                  line_of("angle of edges with tangent planes, degrees", d.edge_angle),
                  line_of("Q1", d.q1),
                  line_of("Q2", d.q2),
                  line_of("quality in the metric", d.metric_quality),
                  line_of("deviation A0, model length", d.deviation),
                  line_of("deviation A1, degrees", d.angle)};
  const auto edges = static_cast<std::int64_t>(d.edges.length.size());
  const auto triangles = static_cast<std::int64_t>(d.triangles.q1.size());
  if (const std::int64_t n = d.short_edges + d.long_edges; n > 0)
    text.not_met.push_back(std::to_string(n) + " of " + std::to_string(edges) + " edges (" + percent(n, edges) +
                           ") have metric lengths outside [0.7071, 1.414]: " + std::to_string(d.short_edges) +
                           " are shorter, " + std::to_string(d.long_edges) + " longer");
  if (d.edges_over_angle > 0)
    text.not_met.push_back(std::to_string(d.edges_over_angle) + " of " + std::to_string(edges) + " edges (" +
                           percent(d.edges_over_angle, edges) + ") make more than " + short_text(d.edge_angle_limit) +
                           " degrees with a tangent plane at their ends; the worst " + short_text(d.edge_angle.max));
  if (d.triangles_over_deviation > 0)
    text.not_met.push_back(std::to_string(d.triangles_over_deviation) + " of " + std::to_string(triangles) +
                           " triangles (" + percent(d.triangles_over_deviation, triangles) + ") are farther than " +
                           short_text(d.deviation_limit) + " from the surface; the worst " +
                           short_text(d.deviation.max));
  if (d.folded_triangles > 0)
    text.not_met.push_back(std::to_string(d.folded_triangles) +
                           " triangles are turned by more than 90 degrees against the surface");
  return text;
}

}  // namespace carreau
