// SPDX-License-Identifier: BSD-3-Clause
// Models whose geometry is known, and their traces.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/analytic_cad.h"
#include "model/topology.h"
#include "support/error.h"

namespace carreau::testing {

constexpr double pi = std::numbers::pi;

/// n + 1 samples of every curve; the sampling is not symmetric, so that curves that are one have other samples.
inline CurveTraces traces_of(const AnalyticCad& cad, int n = 96) {
  CurveTraces traces;
  for (const auto& [ref, face] : cad.faces) {
    auto& of_face = traces.emplace_back();
    for (const AnalyticCurve& curve : face.curves) {
      auto& trace = of_face.emplace_back();
      for (int i = 0; i <= n; ++i) {
        const double s = static_cast<double>(i) / n, w = s + 0.1 * s * (1 - s);
        const double t = i == n ? curve.interval.b : curve.interval.a + w * (curve.interval.b - curve.interval.a);
        trace.push_back(face.at(curve.at(t).c).s);
      }
    }
  }
  return traces;
}

/// The plane z = 0 over some curves.
inline AnalyticFace flat(std::vector<AnalyticCurve> curves) {
  return {[](Vec2 p) { return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }, std::move(curves)};
}

inline AnalyticCad torus() {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) { return torus_jet(p, 2, 0.7); }, rectangle({0, 0}, {2 * pi, 2 * pi})};
  return cad;
}

/// Side of a cylinder of radius 1 and height 2.
inline AnalyticCad cylinder() {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) {
                    SurfaceJet jet;
                    jet.s = {std::cos(p.x()), std::sin(p.x()), p.y()};
                    return jet;
                  },
                  rectangle({0, 0}, {2 * pi, 2})};
  return cad;
}

/// A cone; its apex is the third side.
inline AnalyticCad cone() {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) {
                    SurfaceJet jet;
                    jet.s = {(1 - p.y()) * std::cos(p.x()), (1 - p.y()) * std::sin(p.x()), p.y()};
                    return jet;
                  },
                  rectangle({0, 0}, {2 * pi, 1})};
  return cad;
}

/// Klein's bottle on four squares (RT-0232 sec. 3.1.1 example 1).
inline AnalyticCad klein_bottle() {
  AnalyticCad cad;
  for (int ref = 1; ref <= 4; ++ref) {
    const double u0 = ref <= 2 ? 0 : pi, v0 = ref % 2 == 1 ? 0 : pi;
    cad.faces[ref] = {[ref](Vec2 p) {
                        const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y());
                        const double r = 4 - 2 * cu;
                        SurfaceJet jet;
                        jet.s = ref <= 2 ? Vec3{6 * cu * (1 + su) + r * cu * cv, 16 * su + r * su * cv, r * sv}
                                         : Vec3{6 * cu * (1 + su) - r * cv, 16 * su, r * sv};
                        return jet;
                      },
                      rectangle({u0, v0}, {u0 + pi, v0 + pi})};
  }
  return cad;
}

/// Points less curves plus faces, a degenerate curve being a point.
inline int euler_number(const Topology& topology, const Model& model) {
  int number = static_cast<int>(topology.points.size() + model.faces.size());
  for (const Curve& curve : topology.curves) number -= curve.degenerate ? 0 : 1;
  return number;
}

/// {refc, refp1, refp2} of each curve, in order.
inline std::vector<std::vector<int>> references(const Model& model) {
  std::vector<std::vector<int>> all;
  for (const Face& face : model.faces)
    for (const FaceCurve& curve : face.curves) all.push_back({curve.ref, curve.end1, curve.end2});
  return all;
}

/// The sentence of the E that `act` throws; "" when it throws none.
template <typename E, typename Act>
std::string sentence_of(Act act) {
  try {
    act();
  } catch (const E& error) {
    return error.what();
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace carreau::testing
