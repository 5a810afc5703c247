// SPDX-License-Identifier: BSD-3-Clause
// Geometry in closed form for tests and benchmarks.
#pragma once

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "cad/cad.h"
#include "model/model.h"

namespace carreau::testing {

struct AnalyticCurve {
  Interval interval;
  std::function<CurveJet(double)> at;
};

struct AnalyticFace {
  std::function<SurfaceJet(Vec2)> at;
  std::vector<AnalyticCurve> curves;
};

/// Faces by reference. Counts calls as a cad_m host would: one call a routine and a point.
class AnalyticCad : public Cad {
 public:
  std::map<int, AnalyticFace> faces;
  std::function<std::optional<double>(int, Vec2)> size_on_surface;
  std::function<std::optional<double>(int, int, double)> size_on_curve;
  std::function<std::optional<double>(int)> size_at_point;
  CallCounts calls;

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    for (std::size_t i = 0; i < uv.size(); ++i) {
      out[i] = faces.at(face).at(uv[i]);
      calls.surf0 += (want & want_position) != 0;
      calls.surf1 += (want & want_first) != 0;
      calls.surf2 += (want & want_second) != 0;
    }
  }
  Interval curve_interval(int face, int ic) override { return faces.at(face).curves.at(ic - 1).interval; }
  CurveJet curve(int face, int ic, unsigned, double t) override { return faces.at(face).curves.at(ic - 1).at(t); }
  std::optional<double> surface_size(int face, Vec2 uv) override {
    return size_on_surface ? size_on_surface(face, uv) : std::nullopt;
  }
  std::optional<double> curve_size(int face, int ic, double t) override {
    return size_on_curve ? size_on_curve(face, ic, t) : std::nullopt;
  }
  std::optional<double> point_size(int point) override { return size_at_point ? size_at_point(point) : std::nullopt; }
  [[nodiscard]] CallCounts counts() const noexcept override { return calls; }
};

inline AnalyticCurve segment(Vec2 p, Vec2 q) {
  return {{0, 1}, [p, q](double t) { return CurveJet{p + t * (q - p), q - p, {}}; }};
}

/// Angles in radians; t in [0, 1].
inline AnalyticCurve arc(Vec2 centre, double radius, double from, double to) {
  return {{0, 1}, [=](double t) {
            const double w = to - from, a = from + t * w, c = radius * std::cos(a), s = radius * std::sin(a);
            return CurveJet{{centre.x() + c, centre.y() + s}, {-w * s, w * c}, {-w * w * c, -w * w * s}};
          }};
}

/// The four sides of a rectangle, counterclockwise from its lower side.
inline std::vector<AnalyticCurve> rectangle(Vec2 low, Vec2 high) {
  return {segment(low, {high.x(), low.y()}), segment({high.x(), low.y()}, high), segment(high, {low.x(), high.y()}),
          segment({low.x(), high.y()}, low)};
}

/// A model whose references are all to be found by gluing.
inline Model unglued(const AnalyticCad& cad) {
  Model model;
  for (const auto& [ref, face] : cad.faces) {
    Face f{.ref = ref, .orientation = 1, .curves = {}, .points = {}};
    f.curves.resize(face.curves.size());
    model.faces.push_back(std::move(f));
  }
  return model;
}

/// z = (u^2 + v^2) / 2 (RT-0232 sec. 6.1).
inline SurfaceJet paraboloid_jet(Vec2 p) {
  return {{p.x(), p.y(), (p.x() * p.x() + p.y() * p.y()) / 2}, {1, 0, p.x()}, {0, 1, p.y()}, {0, 0, 1}, {}, {0, 0, 1}};
}

inline AnalyticCad paraboloid() {
  AnalyticCad cad;
  cad.faces[1] = {paraboloid_jet, rectangle({-2.5, -2.5}, {2.5, 2.5})};
  return cad;
}

/// Half of the unit sphere over the unit disc by the inverse stereographic projection (RT-0232 sec. 2.1 example 2, R =
/// 1/2 up to scale).
inline SurfaceJet stereographic_jet(Vec2 p) {
  const double u = p.x(), v = p.y(), d = 1 + u * u + v * v, d2 = d * d, d3 = d2 * d;
  SurfaceJet j;
  j.s = {2 * u / d, 2 * v / d, (2 - d) / d};
  j.su = {2 / d - 4 * u * u / d2, -4 * u * v / d2, -4 * u / d2};
  j.sv = {-4 * u * v / d2, 2 / d - 4 * v * v / d2, -4 * v / d2};
  j.suu = {-12 * u / d2 + 16 * u * u * u / d3, -4 * v / d2 + 16 * u * u * v / d3, -4 / d2 + 16 * u * u / d3};
  j.suv = {-4 * v / d2 + 16 * u * u * v / d3, -4 * u / d2 + 16 * u * v * v / d3, 16 * u * v / d3};
  j.svv = {-4 * u / d2 + 16 * u * v * v / d3, -12 * v / d2 + 16 * v * v * v / d3, -4 / d2 + 16 * v * v / d3};
  return j;
}

inline AnalyticCad hemisphere() {
  constexpr double pi = std::numbers::pi;
  AnalyticCad cad;
  cad.faces[1] = {stereographic_jet, {arc({0, 0}, 1, 0, pi), arc({0, 0}, 1, pi, 2 * pi)}};
  return cad;
}

/// Half of the ellipsoid of half axes (a, b, c), by the same projection.
inline AnalyticCad half_ellipsoid(double a, double b, double c) {
  constexpr double pi = std::numbers::pi;
  const auto jet = [=](Vec2 p) {
    SurfaceJet j = stereographic_jet(p);
    for (Vec3* v : {&j.s, &j.su, &j.sv, &j.suu, &j.suv, &j.svv}) *v = {a * v->x(), b * v->y(), c * v->z()};
    return j;
  };
  AnalyticCad cad;
  cad.faces[1] = {jet, {arc({0, 0}, 1, 0, pi), arc({0, 0}, 1, pi, 2 * pi)}};
  return cad;
}

/// A quarter of a cylinder, as a fillet; u is the angle, v the height.
inline AnalyticCad fillet(double radius, double length) {
  const auto jet = [=](Vec2 p) {
    const double c = radius * std::cos(p.x()), s = radius * std::sin(p.x());
    return SurfaceJet{{c, s, p.y()}, {-s, c, 0}, {0, 0, 1}, {-c, -s, 0}, {}, {}};
  };
  AnalyticCad cad;
  cad.faces[1] = {jet, rectangle({0, 0}, {std::numbers::pi / 2, length})};
  return cad;
}

/// Torus of radii big (to the centre of the tube) and small; u along the big circle, v along the small one.
inline SurfaceJet torus_jet(Vec2 p, double big, double small) {
  const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y()), w = big + small * cv;
  SurfaceJet j;
  j.s = {w * cu, w * su, small * sv};
  j.su = {-w * su, w * cu, 0};
  j.sv = {-small * sv * cu, -small * sv * su, small * cv};
  j.suu = {-w * cu, -w * su, 0};
  j.suv = {small * sv * su, -small * sv * cu, 0};
  j.svv = {-small * cv * cu, -small * cv * su, -small * sv};
  return j;
}

/// A quarter of the big circle, half of the small one.
inline AnalyticCad torus_patch(double big = 2, double small = 0.7) {
  constexpr double pi = std::numbers::pi;
  AnalyticCad cad;
  cad.faces[1] = {[=](Vec2 p) { return torus_jet(p, big, small); }, rectangle({0, 0}, {pi / 2, pi})};
  return cad;
}

/// Bicubic Bezier patch: 16 control points, row by row; u along the rows' index (RT-0232 sec. 6.2).
inline SurfaceJet bezier_jet(const std::array<Vec3, 16>& control, Vec2 p) {
  const auto basis = [](double t, std::array<double, 4>& b, std::array<double, 4>& d, std::array<double, 4>& dd) {
    const double s = 1 - t;
    b = {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
    d = {-3 * s * s, 3 * s * s - 6 * t * s, 6 * t * s - 3 * t * t, 3 * t * t};
    dd = {6 * s, 6 * t - 12 * s, 6 * s - 12 * t, 6 * t};
  };
  std::array<double, 4> bu{}, du{}, ddu{}, bv{}, dv{}, ddv{};
  basis(p.x(), bu, du, ddu);
  basis(p.y(), bv, dv, ddv);
  SurfaceJet j;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) {
      const Vec3 q = control[4 * i + k];
      j.s = j.s + (bu[i] * bv[k]) * q;
      j.su = j.su + (du[i] * bv[k]) * q;
      j.sv = j.sv + (bu[i] * dv[k]) * q;
      j.suu = j.suu + (ddu[i] * bv[k]) * q;
      j.suv = j.suv + (du[i] * dv[k]) * q;
      j.svv = j.svv + (bu[i] * ddv[k]) * q;
    }
  return j;
}

/// Patches of a BPT file (all bicubic), references 1, 2, …
inline AnalyticCad bezier_file(const std::string& path) {
  std::ifstream file(path);
  int count = 0;
  file >> count;
  AnalyticCad cad;
  for (int k = 1; k <= count; ++k) {
    int rows = 0, columns = 0;
    file >> rows >> columns;
    std::array<Vec3, 16> control;
    for (Vec3& q : control) file >> q.x() >> q.y() >> q.z();
    cad.faces[k] = {[control](Vec2 p) { return bezier_jet(control, p); }, rectangle({0, 0}, {1, 1})};
  }
  return cad;
}

inline AnalyticCad teapot() { return bezier_file(CARREAU_SOURCE_DIR "/fortran_examples/teapot/teapot.bpt"); }

}  // namespace carreau::testing
