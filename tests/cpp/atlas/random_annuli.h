// SPDX-License-Identifier: BSD-3-Clause
// Annuli to test with: the three figures of the paper's kind, and random ones.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "atlas/annulus.h"
#include "support/error.h"

namespace carreau::atlas::test {

struct Borders {
  Polygon inner, outer;
};

inline Polygon regular(std::size_t n, double radius, double turn) {
  Polygon p;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = turn + 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    p.push_back({radius * std::cos(t), radius * std::sin(t)});
  }
  return p;
}

/// Two squares (Atlas fig. 5.26), two hexagons (5.27), and one that is not star-shaped (5.28).
inline Borders two_squares() { return {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}}; }
inline Borders two_hexagons() { return {regular(6, 1, 0), regular(6, 2, 0)}; }
inline Borders hook() {
  return {{{0, 0}, {6, 0}, {6, 5}, {3.4, 5}, {3.4, 4}, {5, 4}, {5, 1}, {1, 1}, {1, 6}, {0, 6}},
          {{-.6, -.6},
           {6.6, -.6},
           {6.6, 5.6},
           {2.8, 5.6},
           {2.8, 3.4},
           {4.4, 3.4},
           {4.4, 1.6},
           {1.6, 1.6},
           {1.6, 6.6},
           {-.6, 6.6}}};
}

inline Polygon random_star(std::mt19937_64& random, std::size_t n, double depth) {
  std::uniform_real_distribution<double> unit(0, 1);
  Polygon p;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * (static_cast<double>(i) + .8 * unit(random)) / static_cast<double>(n);
    const double r = 1 - depth * unit(random);
    p.push_back({r * std::cos(t), r * std::sin(t)});
  }
  return p;
}

/// A band of constant width along an Archimedean spiral of pitch 1.
inline Polygon spiral(double turns, std::size_t n, double width) {
  Polygon p;
  const auto put = [&](std::size_t i, double off) {
    const double t = 2 * std::numbers::pi * turns * static_cast<double>(i) / static_cast<double>(n);
    const double r = 1 + t / (2 * std::numbers::pi) + off;
    p.push_back({r * std::cos(t), r * std::sin(t)});
  };
  for (std::size_t i = 0; i <= n; ++i) put(i, width / 2);
  for (std::size_t i = n + 1; i-- > 0;) put(i, -width / 2);
  return p;
}

/// Vertices moved outwards along their bisectors.
inline Polygon widened(const Polygon& p, double by) {
  Polygon wide;
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    Vec2 a = p[i] - p[previous_of(i, n)], b = p[next_of(i, n)] - p[i];
    a /= norm(a), b /= norm(b);
    const Vec2 normal(a.y() + b.y(), -a.x() - b.x());
    wide.push_back(p[i] + by * 2 / std::max(dot(normal, normal), .5) * normal);
  }
  return wide;
}

/// Stars of 4 to 60 sides of three depths, and spirals of up to two turns; empty when no width is found for the polygon
/// drawn.
inline std::optional<Borders> random_borders(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto n = static_cast<std::size_t>(4 + 57 * unit(random));
  const double depths[] = {.2, .6, .85};
  const auto kind = static_cast<std::size_t>(4 * unit(random));
  Borders borders;
  borders.inner = kind == 3 ? spiral(2 * unit(random) + .05, 2 + n / 2, .3 + .4 * unit(random))
                            : random_star(random, n, depths[kind]);
  double by = .02 + .3 * unit(random) * unit(random);
  for (int trial = 0; trial < 12; ++trial, by *= .6) {
    borders.outer = widened(borders.inner, by);
    try {
      require_simple(borders.inner, "the inner border"), require_simple(borders.outer, "the outer border");
      require_annulus(borders.inner, borders.outer);
      return borders;
    } catch (const DomainError&) {
    }
  }
  return {};
}

}  // namespace carreau::atlas::test
