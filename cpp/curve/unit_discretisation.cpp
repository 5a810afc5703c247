// SPDX-License-Identifier: BSD-3-Clause
#include "curve/unit_discretisation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "curve/equal_parts.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {
namespace {

/// More edges than this on one curve are a wrong size, not a mesh.
constexpr double max_edges_of_curve = 20e6;

void check_edge_count(double l) {
  if (l <= max_edges_of_curve) return;
  throw LimitError("the sizes along a curve require " + format_number(std::ceil(l)) + " edges; the limit is " +
                   format_number(max_edges_of_curve));
}

/// log1p(x) / x, continuous at 0.
double log_ratio(double x) noexcept { return x == 0 ? 1 : std::log1p(x) / x; }

/// Fraction S_X of a segment at which the fraction L_X of its normalised length is reached (RR-2818 sec. 5.4). The
/// formulas are written with log1p and expm1, so that they hold for nearly equal sizes without the paper's series.
double fraction_at(SizeLaw law, double h1, double h2, double lx) noexcept {
  const double x = (h2 - h1) / h1;
  switch (law) {
    case SizeLaw::linear:
      // S_X = h1 ((h2 / h1)^L_X - 1) / (h2 - h1)
      return x == 0 ? lx : std::expm1(lx * std::log1p(x)) / x;
    case SizeLaw::geometric: {
      // S_X = log(h2 / (h2 + L_X (h1 - h2))) / log(h2 / h1)
      const double l = std::log1p(x);
      return l == 0 ? lx : -std::log1p(lx * std::expm1(-l)) / l;
    }
    case SizeLaw::sinusoidal: {
      // S_X = (2 / pi) atan(tan(L_X pi / 2) sqrt(h1 h2) / h2), with atan2 because L_X = 1 is allowed
      const double angle = lx * std::numbers::pi / 2;
      return std::atan2(std::sin(angle) * std::sqrt(h1), std::cos(angle) * std::sqrt(h2)) * 2 / std::numbers::pi;
    }
  }
  return lx;
}

void check_sizes(std::span<const double> s, std::span<const double> h) {
  if (s.size() != h.size() || s.size() < 2) {
    throw InvalidArgument("a curve needs as many sizes as abscissae, and at least two; there are " +
                          std::to_string(h.size()) + " and " + std::to_string(s.size()));
  }
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (!(h[i] > 0) || !std::isfinite(h[i])) {
      throw InvalidArgument("sizes along a curve must be positive and finite; one is " + format_number(h[i]));
    }
    if (!std::isfinite(s[i]) || (i > 0 && s[i] < s[i - 1])) {
      throw InvalidArgument("abscissae along a curve must be finite and ascending; one is " + format_number(s[i]));
    }
  }
}

}  // namespace

double normalised_length(SizeLaw law, double h1, double h2, double d) noexcept {
  const double x = (h2 - h1) / h1;
  switch (law) {
    case SizeLaw::linear:  // d log(h2 / h1) / (h2 - h1)
      return d / h1 * log_ratio(x);
    case SizeLaw::geometric: {  // d (h2 - h1) / (h1 h2 log(h2 / h1))
      const double l = std::log1p(x);
      return l == 0 ? d / h1 : d / h1 * (-std::expm1(-l) / l);
    }
    case SizeLaw::sinusoidal:  // d / sqrt(h1 h2)
      return d / (std::sqrt(h1) * std::sqrt(h2));
  }
  return d / h1;
}

double distance_at_normalised_length(SizeLaw law, double h1, double h2, double d, double target) noexcept {
  const double total = normalised_length(law, h1, h2, d);
  if (!(total > 0)) return 0;
  return d * std::clamp(fraction_at(law, h1, h2, std::clamp(target / total, 0., 1.)), 0., 1.);
}

int unit_edge_count(double l) noexcept {
  if (!(l >= 1)) return 1;  // l^2 < 1 < 1 * 2
  if (l >= std::numeric_limits<int>::max()) return std::numeric_limits<int>::max();
  const double n = std::floor(l);
  return static_cast<int>(n * (n + 1) < l * l ? n + 1 : n);
}

double normalised_length(std::span<const double> s, std::span<const double> h, SizeLaw law) {
  check_sizes(s, h);
  double l = 0;
  for (std::size_t i = 0; i + 1 < s.size(); ++i) l += normalised_length(law, h[i], h[i + 1], s[i + 1] - s[i]);
  return l;
}

std::vector<double> split_by_sizes(std::span<const double> s, std::span<const double> h, SizeLaw law, int at_least) {
  check_sizes(s, h);
  std::vector<double> l(s.size(), 0);
  for (std::size_t i = 0; i + 1 < s.size(); ++i) {
    l[i + 1] = l[i] + normalised_length(law, h[i], h[i + 1], s[i + 1] - s[i]);
  }
  check_edge_count(l.back());
  return equal_parts(s, l, std::max(unit_edge_count(l.back()), at_least), [&](std::size_t i, double length) {
    return distance_at_normalised_length(law, h[i], h[i + 1], s[i + 1] - s[i], length);
  });
}

}  // namespace carreau
