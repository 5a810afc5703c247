// SPDX-License-Identifier: BSD-3-Clause
// Analytic metric fields on parameter domains, for the tests and the benchmark of the control space.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "control_space/control_space.h"

namespace carreau::fields {

inline constexpr double pi = std::numbers::pi;

struct Field {
  std::string name;
  SampledDomain domain;
  std::function<Metric2(Vec2)> metric;
};

using Loop = std::vector<Vec2>;

inline SampledDomain domain_of(const std::vector<Loop>& loops) {
  SampledDomain d;
  for (const Loop& loop : loops) {
    const int first = static_cast<int>(d.vertices.size()), n = static_cast<int>(loop.size());
    for (int i = 0; i < n; ++i) {
      d.vertices.push_back(loop[i]);
      d.edges.emplace_back(first + i, first + (i + 1) % n);
    }
  }
  return d;
}

/// n edges on each side.
inline Loop polygon(const Loop& corners, int n) {
  Loop loop;
  for (std::size_t k = 0; k < corners.size(); ++k)
    for (int i = 0; i < n; ++i)
      // Not lerp: sides along an axis keep their coordinate exactly.
      loop.push_back(corners[k] + static_cast<double>(i) / n * (corners[(k + 1) % corners.size()] - corners[k]));
  return loop;
}

inline Loop rectangle(Vec2 low, Vec2 high, int n) { return polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, n); }

inline Loop circle(Vec2 centre, double radius, int n) {
  Loop loop;
  for (int i = 0; i < n; ++i)
    loop.push_back({centre.x() + radius * std::cos(2 * pi * i / n), centre.y() + radius * std::sin(2 * pi * i / n)});
  return loop;
}

inline int edges_along(double length, double h) { return std::max(2, static_cast<int>(std::ceil(length / h))); }

/// z = (u^2 + v^2) / 2 on [-2.5, 2.5]^2.
inline Metric2 paraboloid_metric(Vec2 p, double h) { return induced_metric({1, 0, p.x()}, {0, 1, p.y()}, h); }
inline Field paraboloid(double h) {
  return {"paraboloid", domain_of({rectangle({-2.5, -2.5}, {2.5, 2.5}, edges_along(7.5, h))}),
          [h](Vec2 p) { return paraboloid_metric(p, h); }};
}
inline Field paraboloid_on_disc(double h) {
  return {"paraboloid on a disc", domain_of({circle({0.1, 0}, 2.5, edges_along(17, h))}),
          [h](Vec2 p) { return paraboloid_metric(p, h); }};
}
/// An L with its notch off the lines of any regular grid.
inline Field paraboloid_on_l_shape(double h) {
  const Loop corners{{-2.5, -2.5}, {2.5, -2.5}, {2.5, 0.31}, {-0.43, 0.31}, {-0.43, 2.5}, {-2.5, 2.5}};
  return {"paraboloid on an L", domain_of({polygon(corners, edges_along(5, h))}),
          [h](Vec2 p) { return paraboloid_metric(p, h); }};
}
inline Field wavy_plate_with_holes(double h) {
  const auto metric = [h](Vec2 p) {
    const double u = 0.6 * std::cos(2 * p.x()) * std::sin(2 * p.y()), v = 0.6 * std::sin(2 * p.x()) * std::cos(2 * p.y());
    return induced_metric({1, 0, u}, {0, 1, v}, h);
  };
  return {"wavy plate with holes",
          domain_of({rectangle({-1, -1}, {1, 1}, edges_along(2, h)), circle({0.1, 0.1}, 0.35, edges_along(2.2, h)),
                     circle({-0.55, -0.4}, 0.2, edges_along(1.2, h)), circle({-0.6, 0.6}, 0.02, 16),
                     rectangle({-0.3, -0.75}, {0.4, -0.74}, edges_along(0.7, h))}),
          metric};
}
/// Stereographic projection of a hemisphere from the unit disc.
inline Field hemisphere(double h) {
  return {"stereographic hemisphere", domain_of({circle({0, 0}, 1, edges_along(2 * pi, h))}), [h](Vec2 p) {
            const double d = 1 + dot(p, p), k = 4 / (d * d * h * h);
            return Metric2{k, 0, k};
          }};
}
inline Field torus(double h) {
  return {"torus", domain_of({rectangle({0, 0}, {2 * pi, 2 * pi}, edges_along(2 * pi, h))}), [h](Vec2 p) {
            const double r = 2 + std::cos(p.y());
            return Metric2{r * r / (h * h), 0, 1 / (h * h)};
          }};
}
/// Half axes 1, 1, 2; the size is 2 sin(angle) times the smallest radius of curvature.
inline Field ellipsoid_by_curvature(double angle) {
  return {"ellipsoid, sizes by curvature", domain_of({rectangle({0, -1.2}, {2 * pi, 1.2}, 60)}), [angle](Vec2 p) {
            const double c = std::cos(p.y()), s = std::sin(p.y()), e = c * c, g = s * s + 4 * c * c;
            const double curvature = std::max(2 / std::pow(g, 1.5), 2 / std::sqrt(g));
            const double h = 2 * std::sin(angle) / curvature;
            return Metric2{e / (h * h), 0, g / (h * h)};
          }};
}
/// A disc turned by an angle that falls from `turn` in the middle to 0 at the rim: sheared, and the metric turns.
inline Field swirl(double turn, double h) {
  return {"swirl", domain_of({circle({0, 0}, 1, edges_along(2 * pi, h))}), [turn, h](Vec2 p) {
            // S = R(g) p, 0.3 r^2 with g = turn (1 - r^2)^2: dS = R (dp + dg J p).
            const double r2 = dot(p, p);
            const Vec2 dg = -4 * turn * (1 - r2) * p;
            const Vec3 su{1 - dg.x() * p.y(), dg.x() * p.x(), 0.6 * p.x()}, sv{-dg.y() * p.y(), 1 + dg.y() * p.x(), 0.6 * p.y()};
            return induced_metric(su, sv, h);
          }};
}
/// Unit sphere in longitude and latitude, up to the pole: the upper side is a point.
inline Field sphere_with_pole(double h) {
  return {"sphere with a pole", domain_of({rectangle({0, -1}, {2 * pi, pi / 2}, edges_along(2 * pi, h))}), [h](Vec2 p) {
            const double c = std::cos(p.y());
            return Metric2{c * c / (h * h), 0, 1 / (h * h)};
          }};
}
/// z = sqrt(1 - u^2 - v^2) on a disc of radius 0.95: undefined at the corners of the disc's box.
inline Field sphere_by_projection(double h) {
  return {"sphere by projection", domain_of({circle({0, 0}, 0.95, edges_along(2 * pi, h))}), [h](Vec2 p) {
            const double z = std::sqrt(1 - dot(p, p));
            return induced_metric({1, 0, -p.x() / z}, {0, 1, -p.y() / z}, h);
          }};
}
/// Sizes from 0.1 scale along a sharp ring to scale, with slope 2.6 scale.
inline Field ring(double scale) {
  return {"sharp ring", domain_of({rectangle({-2, -2}, {2, 2}, edges_along(4, scale))}), [scale](Vec2 p) {
            const double d = std::hypot(norm(p) - 1.2, 0.01);
            const double h = scale * std::min(1.0, 0.1 + 2.6 * (d - 0.01));
            const double u = 0.25 * std::cos(p.x()) * std::cos(p.y()), v = -0.25 * std::sin(p.x()) * std::sin(p.y());
            return induced_metric({1, 0, u}, {0, 1, v}, h);
          }};
}
/// Sizes from 1/1000 to the tenth of the square, linear about a point.
inline Field thousandfold_sizes() {
  return {"sizes 1 : 1000", domain_of({rectangle({0, 0}, {1, 1}, 20)}), [](Vec2 p) {
            const double h = 1e-4 + 0.1 * norm(p - Vec2{0.3, 0.4});
            return Metric2{1 / (h * h), 0, 1 / (h * h)};
          }};
}

}  // namespace carreau::fields
