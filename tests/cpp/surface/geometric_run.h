// SPDX-License-Identifier: BSD-3-Clause
// Meshes of analytic surfaces whose sizes come from their curvature.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "common/analytic_cad.h"
#include "session/session.h"

namespace carreau::testing {

inline AnalyticCad one_face(std::function<SurfaceJet(Vec2)> at, std::vector<AnalyticCurve> curves) {
  AnalyticCad cad;
  cad.faces[1] = {std::move(at), std::move(curves)};
  return cad;
}

/// Half axes a, b, c; u longitude, v latitude.
inline SurfaceJet ellipsoid_jet(Vec2 p, Vec3 axes) {
  const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y());
  const auto scaled = [&](double x, double y, double z) { return Vec3{axes.x() * x, axes.y() * y, axes.z() * z}; };
  return {scaled(cu * cv, su * cv, sv),  scaled(-su * cv, cu * cv, 0), scaled(-cu * sv, -su * sv, cv),
          scaled(-cu * cv, -su * cv, 0), scaled(su * sv, -cu * sv, 0), scaled(-cu * cv, -su * cv, -sv)};
}

/// All with a diagonal of a few units; the sphere and the ellipsoid whole, with poles and a seam; a quarter of the
/// torus, with a seam.
inline AnalyticCad sphere() {
  return one_face(
      [](Vec2 p) {
        return ellipsoid_jet(p, {1, 1, 1});
      },
      rectangle({0, -std::numbers::pi / 2}, {2 * std::numbers::pi, std::numbers::pi / 2}));
}
inline AnalyticCad ellipsoid() {
  return one_face(
      [](Vec2 p) {
        return ellipsoid_jet(p, {1, 0.8, 0.5});
      },
      rectangle({0, -std::numbers::pi / 2}, {2 * std::numbers::pi, std::numbers::pi / 2}));
}
inline AnalyticCad torus() {
  return one_face([](Vec2 p) { return torus_jet(p, 1, 0.4); },
                  rectangle({0, 0}, {std::numbers::pi / 2, 2 * std::numbers::pi}));
}
inline AnalyticCad wide_paraboloid() { return one_face(paraboloid_jet, rectangle({-1.5, -1.5}, {1.5, 1.5})); }

struct Surface {
  const char* name;
  AnalyticCad (*make)();
};
inline const Surface surfaces[] = {
    {"sphere", sphere}, {"torus", torus}, {"paraboloid", wide_paraboloid}, {"ellipsoid", ellipsoid}};

struct GeometricRun {
  std::unique_ptr<Monitor> monitor = std::make_unique<Monitor>();
  std::unique_ptr<Session> session = std::make_unique<Session>(*monitor);

  GeometricRun(AnalyticCad geometry, const std::function<void(Parameters&)>& more) {
    auto cad = std::make_shared<AnalyticCad>(std::move(geometry));
    session->set_cad(cad);
    session->set_model(unglued(*cad));
    Parameters& p = session->parameters();
    p.set("hphy_flag", 0);
    p.set("hgeo_flag", 1);
    p.set("hgeomin", 1e-5);
    p.set("hgeomax", 10.0);
    p.set("geo_guarantee", 1);
    p.set("max_triangles", 1000000);
    more(p);
    session->make_mesh();
    EXPECT_EQ(find_defects(session->mesh()), std::vector<std::string>{});
  }
};

}  // namespace carreau::testing
