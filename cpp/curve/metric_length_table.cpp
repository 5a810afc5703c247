// SPDX-License-Identifier: BSD-3-Clause
#include "curve/metric_length_table.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "curve/equal_parts.h"
#include "curve/unit_discretisation.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {
namespace {

constexpr double max_edges = 20e6;
/// Largest change of a trapezoid by halving, unit edges. An edge of unit length has some four trapezoids, whose errors
/// are a third of it: its error is at most 0.3 %.
constexpr double trapezoid_tolerance = 0.002;

void check_count(double l) {
  if (l <= max_edges) return;
  throw LimitError("the metrics along a curve require more than " + format_number(max_edges) + " edges");
}

void check_breaks(std::span<const double> breaks, double lss) {
  if (!(lss > 0)) throw InvalidArgument("LSS must be positive; it is " + format_number(lss));
  if (breaks.size() < 2) throw InvalidArgument("a curve to be measured in a metric needs two abscissae at least");
  for (std::size_t i = 0; i < breaks.size(); ++i)
    if (!std::isfinite(breaks[i]) || (i > 0 && breaks[i] <= breaks[i - 1]))
      throw InvalidArgument("abscissae along a curve must be finite and strictly ascending; one is " +
                            format_number(breaks[i]));
}

/// Distance from the start of an interval of width w at which the metric length reaches `length`. It is the root of
/// first d + (last - first) d^2 / (2 w) = length, in the form that does not cancel.
double distance_within(double first, double last, double w, double length) noexcept {
  if (!(length > 0)) return 0;
  const double root = std::sqrt(std::max(first * first + 2 * (last - first) * length / w, 0.));
  const double denominator = first + root;
  return denominator > 0 ? std::min(2 * length / denominator, w) : w;
}

/// Measures one piece after the other; a piece's intervals come from left to right.
class Measure {
 public:
  Measure(const PieceSpeed& speed, double lss, double start) : speed_(speed), lss_(lss) {
    result_.s.push_back(start);
    result_.l.push_back(0);
  }

  void add_piece(std::size_t piece, double end) {
    piece_ = piece;
    Node left{result_.s.back(), speed_at(result_.s.back())};
    pending_.assign(1, {end, speed_at(end)});
    // Before a hopeless table is filled.
    check_count(result_.l.back() + (end - left.s) * (left.f + pending_.back().f) / 2);
    while (!pending_.empty()) {
      const Node right = pending_.back();
      const double width = right.s - left.s, middle = left.s + width / 2;
      if (!(middle > left.s) || !(middle < right.s)) {
        add(left, right);
        left = right;
        pending_.pop_back();
        continue;
      }
      const double f = speed_at(middle);
      const double whole = width * (left.f + right.f) / 2, halves = width * (left.f + 2 * f + right.f) / 4;
      // The middle is kept in any case: its evaluation is already paid for.
      if (whole <= lss_ && std::abs(halves - whole) <= trapezoid_tolerance) {
        add(left, {middle, f});
        add({middle, f}, right);
        left = right;
        pending_.pop_back();
        continue;
      }
      check_count(result_.l.back() + static_cast<double>(pending_.size()) * lss_);
      pending_.push_back({middle, f});
    }
  }
  MetricLengthTable take() { return std::move(result_); }

 private:
  struct Node {
    double s, f;
  };

  double speed_at(double s) const {
    const double f = speed_(piece_, s);
    if (!std::isfinite(f) || f < 0)
      throw InvalidArgument("the metric gives the speed " + format_number(f) + " at abscissa " + format_number(s));
    return f;
  }
  void add(Node left, Node right) {
    const double l = result_.l.back() + (right.s - left.s) * (left.f + right.f) / 2;
    check_count(l);
    result_.s.push_back(right.s);
    result_.l.push_back(l);
    result_.first.push_back(left.f);
    result_.last.push_back(right.f);
  }

  const PieceSpeed& speed_;
  double lss_;
  std::size_t piece_ = 0;
  std::vector<Node> pending_;
  MetricLengthTable result_;
};

}  // namespace

double MetricLengthTable::metric_abscissa(double at) const noexcept {
  if (at <= s.front()) return 0;
  if (at >= s.back()) return l.back();
  const auto i = static_cast<std::size_t>(std::upper_bound(s.begin(), s.end(), at) - s.begin()) - 1;
  const double d = at - s[i];
  return l[i] + d * (first[i] + (last[i] - first[i]) * d / (2 * (s[i + 1] - s[i])));
}

MetricLengthTable measure_curve(const PieceSpeed& speed, std::span<const double> breaks, double lss) {
  check_breaks(breaks, lss);
  Measure measure(speed, lss, breaks.front());
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) measure.add_piece(i, breaks[i + 1]);
  return measure.take();
}

std::vector<double> split_equally(const MetricLengthTable& gradation, int n) {
  if (n < 1) throw InvalidArgument("a curve has at least one edge, not " + std::to_string(n));
  const auto& [s, l, first, last] = gradation;
  return equal_parts(s, l, n, [&, &first = first, &last = last, &s = s](std::size_t i, double length) {
    return distance_within(first[i], last[i], s[i + 1] - s[i], length);
  });
}

std::vector<double> split_by_metric(const std::function<double(double)>& speed, double total, double lss) {
  if (!(total > 0) || !std::isfinite(total) || !(lss > 0)) {
    throw InvalidArgument("a curve must have a positive length and LSS must be positive; they are " +
                          format_number(total) + " and " + format_number(lss));
  }
  // Starting with 8 intervals instead of one keeps a size that is coarse at both ends from hiding a fine middle.
  constexpr int intervals = 8;
  std::vector<double> breaks;
  for (int i = 0; i <= intervals; ++i) breaks.push_back(total * i / intervals);
  const MetricLengthTable gradation = measure_curve([&](std::size_t, double s) { return speed(s); }, breaks, lss);
  return split_equally(gradation, unit_edge_count(gradation.length()));
}

}  // namespace carreau
