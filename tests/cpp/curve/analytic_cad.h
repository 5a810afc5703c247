// SPDX-License-Identifier: BSD-3-Clause
// A host made of closed forms, which counts its calls.
#pragma once

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "cad/cad.h"

namespace carreau::testing_cad {

struct Surface {
  std::function<SurfaceJet(Vec2)> jet;
};

struct PlaneCurve {
  Interval interval;
  std::function<CurveJet(double)> jet;
};

class AnalyticCad : public Cad {
 public:
  std::map<int, Surface> surfaces;                   ///< by face reference
  std::map<std::pair<int, int>, PlaneCurve> curves;  ///< by (face, ic)
  std::function<std::optional<double>(int, Vec2)> hphys = [](int, Vec2) { return std::optional<double>{}; };
  std::function<std::optional<double>(int, int, double)> hphyc = [](int, int, double) {
    return std::optional<double>{};
  };
  std::function<std::optional<double>(int)> hphyp = [](int) { return std::optional<double>{}; };
  std::function<std::optional<double>(int, Vec2)> rads = [](int, Vec2) { return std::optional<double>{}; };
  std::function<std::optional<double>(int, int, double)> radc = [](int, int, double) {
    return std::optional<double>{};
  };

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    const auto n = static_cast<std::int64_t>(uv.size());
    if (want & want_position) calls.surf0 += n;
    if (want & want_first) calls.surf1 += n;
    if (want & want_second) calls.surf2 += n;
    for (std::size_t i = 0; i < uv.size(); ++i) out[i] = surfaces.at(face).jet(uv[i]);
  }
  Interval curve_interval(int face, int ic) override { return curves.at({face, ic}).interval; }
  CurveJet curve(int face, int ic, unsigned, double t) override {
    ++calls.curv0;
    return curves.at({face, ic}).jet(t);
  }
  std::optional<double> surface_size(int face, Vec2 uv) override {
    ++calls.sizes;
    return hphys(face, uv);
  }
  std::optional<double> curve_size(int face, int ic, double t) override {
    ++calls.sizes;
    return hphyc(face, ic, t);
  }
  std::optional<double> point_size(int point) override {
    ++calls.sizes;
    return hphyp(point);
  }
  std::optional<double> surface_radius(int face, Vec2 uv) override { return rads(face, uv); }
  std::optional<double> curve_radius(int face, int ic, double t) override { return radc(face, ic, t); }
  [[nodiscard]] CallCounts counts() const noexcept override { return calls; }

  CallCounts calls;
};

/// z = 0.
inline Surface flat() {
  return {[](Vec2 p) {
    SurfaceJet j;
    j.s = {p.x(), p.y(), 0};
    j.su = {1, 0, 0};
    j.sv = {0, 1, 0};
    return j;
  }};
}

/// z = (u^2 + v^2) / 2 (RT-0232 sec. 6.1).
inline Surface paraboloid() {
  return {[](Vec2 p) {
    SurfaceJet j;
    j.s = {p.x(), p.y(), (p.x() * p.x() + p.y() * p.y()) / 2};
    j.su = {1, 0, p.x()};
    j.sv = {0, 1, p.y()};
    j.suu = j.svv = {0, 0, 1};
    return j;
  }};
}

/// Sphere of radius R about the origin, u = longitude, v = latitude: poles at v = +-pi/2.
inline Surface sphere(double R) {
  return {[R](Vec2 p) {
    const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y());
    SurfaceJet j;
    j.s = {R * cu * cv, R * su * cv, R * sv};
    j.su = {-R * su * cv, R * cu * cv, 0};
    j.sv = {-R * cu * sv, -R * su * sv, R * cv};
    j.suu = {-R * cu * cv, -R * su * cv, 0};
    j.suv = {R * su * sv, -R * cu * sv, 0};
    j.svv = {-R * cu * cv, -R * su * cv, -R * sv};
    return j;
  }};
}

/// Cylinder of radius R about the z axis, u = angle, v = height.
inline Surface cylinder(double R) {
  return {[R](Vec2 p) {
    const double c = std::cos(p.x()), s = std::sin(p.x());
    SurfaceJet j;
    j.s = {R * c, R * s, p.y()};
    j.su = {-R * s, R * c, 0};
    j.sv = {0, 0, 1};
    j.suu = {-R * c, -R * s, 0};
    return j;
  }};
}

/// Straight from p to q for t in [0, 1].
inline PlaneCurve segment(Vec2 p, Vec2 q) {
  return {{0, 1}, [p, q](double t) { return CurveJet{lerp(p, q, t), q - p, {}}; }};
}

/// Any function; derivatives by central differences, good enough for the tests that use them.
inline PlaneCurve plane_curve(Interval interval, std::function<Vec2(double)> f) {
  return {interval, [f](double t) {
            const double e = 1e-4;
            const Vec2 l = f(t - e), m = f(t), r = f(t + e);
            return CurveJet{m, (1 / (2 * e)) * (r - l), (1 / (e * e)) * (l + r - 2 * m)};
          }};
}

}  // namespace carreau::testing_cad
