// SPDX-License-Identifier: BSD-3-Clause
// Surfaces under smooth isotropic size fields whose slope is bounded: cases on which a unit mesh must be good
// everywhere.
#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <numbers>
#include <vector>

#include "common/analytic_cad.h"
#include "common/field_source.h"
#include "session/session.h"

namespace carreau::testing {

/// A size of space: from h to 10 h, slope at most `slope`.
using SizeField = double (*)(Vec3 p, double h, double slope);

/// h + slope d from d = 0 on, rounded over one h, and towards 10 h.
inline double size_at_distance(double d, double h, double slope) {
  constexpr int sharpness = 8;
  const double rounded = std::sqrt(d * d + h * h) - h, x = slope * rounded / (9 * h);
  return h + 9 * h * x / std::pow(1 + std::pow(x, sharpness), 1.0 / sharpness);
}
inline double two_sources(Vec3 p, Vec3 a, Vec3 b, double h, double slope) {
  constexpr int sharpness = 4;  // the smaller distance, rounded where they are equal
  const auto far = [&](Vec3 c) { return std::pow(norm(p - c) + 1e-9, -sharpness); };
  return size_at_distance(std::pow(far(a) + far(b), -1.0 / sharpness), h, slope);
}
/// Waves along two directions, between the extreme sizes.
inline double waves(Vec3 p, double h, double slope) {
  const double k = slope * std::numbers::sqrt2 / (4.5 * h);
  return h * (5.5 + 2.25 * (std::sin(k * (0.8 * p.x() + 0.6 * p.z())) + std::sin(k * p.y())));
}
/// Waves along one direction, with crests across the axes.
inline double ripples(Vec3 p, double h, double slope) {
  const double k = slope / (4.5 * h);
  return h * (5.5 + 4.5 * std::sin(k * (0.48 * p.x() + 0.64 * p.y() + 0.6 * p.z())));
}

struct NamedField {
  const char* name;
  SizeField size;
};
inline const NamedField size_fields[] = {
    {"ring", [](Vec3 p, double h, double g) { return size_at_distance(std::hypot(p.x(), p.y()) - 0.8, h, g); }},
    {"line", [](Vec3 p, double h, double g) { return size_at_distance(0.96 * p.x() + 0.28 * p.y() - 0.1, h, g); }},
    {"point",
     [](Vec3 p, double h, double g) {
       return size_at_distance(norm(p - Vec3{0.8, 0.4, 0.4}), h, g);
     }},
    {"two",
     [](Vec3 p, double h, double g) {
       return two_sources(p, {0.9, 0.1, 0.3}, {-0.7, 0.6, 0.1}, h, g);
     }},
    {"waves", waves},
    {"ripples", ripples},
};

struct NamedSurface {
  const char* name;
  std::function<SurfaceJet(Vec2)> at;
  Vec2 low, high;
  [[nodiscard]] AnalyticCad cad() const {
    AnalyticCad cad;
    cad.faces[1] = {at, rectangle(low, high)};
    return cad;
  }
};
/// Sphere and torus whole, as a user has them: longitude and latitude with poles and a seam; two seams.
inline const NamedSurface graded_surfaces[] = {
    {"plane",
     [](Vec2 p) {
       return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}};
     },
     {-2, -2},
     {2, 2}},
    {"paraboloid", paraboloid_jet, {-1.5, -1.5}, {1.5, 1.5}},
    {"sphere",
     [](Vec2 p) {
       const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y());
       return SurfaceJet{{cu * cv, su * cv, sv},  {-su * cv, cu * cv, 0}, {-cu * sv, -su * sv, cv},
                         {-cu * cv, -su * cv, 0}, {su * sv, -cu * sv, 0}, {-cu * cv, -su * cv, -sv}};
     },
     {0, -std::numbers::pi / 2},
     {2 * std::numbers::pi, std::numbers::pi / 2}},
    {"torus", [](Vec2 p) { return torus_jet(p, 1, 0.4); }, {0, 0}, {2 * std::numbers::pi, 2 * std::numbers::pi}},
};

/// Smallest size for which the surface holds about so many unit triangles.
inline double size_for(const NamedSurface& surface, SizeField size, double slope, double triangles) {
  constexpr int n = 400;
  std::vector<Vec3> places;
  std::vector<double> areas;
  const Vec2 cell{(surface.high.x() - surface.low.x()) / n, (surface.high.y() - surface.low.y()) / n};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const SurfaceJet s = surface.at({surface.low.x() + (i + 0.5) * cell.x(), surface.low.y() + (j + 0.5) * cell.y()});
      places.push_back(s.s);
      areas.push_back(norm(cross(s.su, s.sv)) * cell.x() * cell.y());
    }
  double low = 1e-4, high = 1;
  for (int step = 0; step < 30; ++step) {
    const double h = std::sqrt(low * high);
    double count = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double s = size(places[k], h, slope);
      count += areas[k] / (0.25 * std::numbers::sqrt3 * s * s);
    }
    (count > triangles ? low : high) = h;
  }
  return std::sqrt(low * high);
}

/// A session that holds the unit mesh.
struct GradedRun {
  double h;
  Monitor monitor;
  std::unique_ptr<Session> session = std::make_unique<Session>(monitor);

  double seconds = 0;  ///< of the processor

  GradedRun(const NamedSurface& surface, SizeField size, double slope, double triangles)
      : h(size_for(surface, size, slope, triangles)) {
    const auto cad = std::make_shared<AnalyticCad>(surface.cad());
    session->set_cad(cad);
    session->set_model(unglued(*cad));
    session->set_prescription_source(std::make_shared<FieldSource>(
        field_of_space([size, slope, h = h](Vec3 p) { return Prescription::of_size(size(p, h, slope)); })));
    Parameters& p = session->parameters();
    p.set("hphymin", h / 10);
    p.set("hphymax", 100 * h);
    const std::clock_t start = std::clock();
    session->make_mesh();
    seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
};

}  // namespace carreau::testing
