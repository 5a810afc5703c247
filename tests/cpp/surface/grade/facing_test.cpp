// SPDX-License-Identifier: BSD-3-Clause
// Narrow zones between faces that share nothing: layers across gaps of space.
#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "common/analytic_cad.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
constexpr double pi = std::numbers::pi;

testing::AnalyticFace plate(Vec3 o, Vec3 x, Vec3 y) {
  return {[=](Vec2 p) { return SurfaceJet{o + p.x() * x + p.y() * y, x, y, {}, {}, {}}; },
          testing::rectangle({0, 0}, {1, 1})};
}

testing::AnalyticFace tube(double radius, double length) {
  return {[=](Vec2 p) {
            const double c = radius * std::cos(p.x()), s = radius * std::sin(p.x());
            return SurfaceJet{{c, s, p.y()}, {-s, c, 0}, {0, 0, 1}, {-c, -s, 0}, {}, {}};
          },
          testing::rectangle({0, 0}, {2 * pi, length})};
}

struct FacingRun {
  Monitor monitor;
  Session session{monitor};

  FacingRun(AnalyticCad geometry, int layers, double h, const std::function<void(Parameters&)>& more = {}) {
    auto cad = std::make_shared<AnalyticCad>(std::move(geometry));
    session.set_cad(cad);
    session.set_model(testing::unglued(*cad));
    Parameters& p = session.parameters();
    p.set("hphy_flag", 1);
    p.set("hphydef", h);
    p.set("hphymin", 1e-3);
    p.set("hphymax", 10.);
    p.set("gradation", 1.3);
    p.set("proximity", layers);
    p.set("eps_glue", 1e-4);
    if (more) more(p);
    session.make_mesh();
    EXPECT_EQ(find_defects(session.mesh()), std::vector<std::string>{});
  }
  /// Smallest and largest size at the vertices of a face that are inside `where`.
  [[nodiscard]] std::array<double, 2> sizes(
      std::size_t face, const std::function<bool(Vec3)>& where = [](Vec3) { return true; }) const {
    std::array<double, 2> range{1e300, 0};
    for (const int v : session.mesh().faces[face].vertex) {
      if (!where(session.mesh().vertices[v])) continue;
      const double h = session.vertex_sizes()[v];
      range = {std::min(range[0], h), std::max(range[1], h)};
    }
    return range;
  }
};

void expect_sizes(std::array<double, 2> range, double wanted, double error) {
  EXPECT_GE(range[0], (1 - error) * wanted);
  EXPECT_LE(range[1], (1 + error) * wanted);
}

TEST(Facing, TwoPlates) {
  for (const double gap : {0.15, 0.06})
    for (const int layers : {1, 3}) {
      SCOPED_TRACE(std::to_string(gap) + ", layers " + std::to_string(layers));
      AnalyticCad cad;
      cad.faces[1] = plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
      cad.faces[2] = plate({0, 0, gap}, {1, 0, 0}, {0, 1, 0});
      const FacingRun run(std::move(cad), layers, 0.25);
      for (const std::size_t face : {0, 1}) expect_sizes(run.sizes(face), std::min(0.25, gap / layers), 0.01);
    }
}

TEST(Facing, PlatesFarApartOrInContactAreLeftAlone) {
  for (const double gap : {0.8, 0.}) {
    AnalyticCad cad;
    cad.faces[1] = plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    cad.faces[2] = plate({0.3, 0.3, gap}, {0.3, 0, 0}, {0, 0.3, 0});
    const FacingRun run(std::move(cad), 3, 0.25);
    for (const std::size_t face : {0, 1}) expect_sizes(run.sizes(face), 0.25, 1e-9);
  }
}

// No vertex of the large one need lie above the small one.
TEST(Facing, ASmallPlateAboveALargeOne) {
  AnalyticCad cad;
  cad.faces[1] = plate({-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
  cad.faces[2] = plate({-0.1, -0.1, 0.06}, {0.2, 0, 0}, {0, 0.2, 0});
  const FacingRun run(std::move(cad), 3, 0.5);
  expect_sizes(run.sizes(1), 0.02, 0.01);
  const auto below = [](Vec3 x) { return std::max(std::abs(x.x()), std::abs(x.y())) < 0.1; };
  // Between two closest points, which are two sizes apart, it grows from both by at most a factor of 1.3.
  EXPECT_GE(run.sizes(0, below)[0], 0.99 * 0.02);
  EXPECT_LE(run.sizes(0, below)[1], 1.3 * 0.02);
  // And from there it grows as the gradation has it.
  const auto away = [](Vec3 x) { return x.y() == 0 && std::abs(x.x() - 0.6) < 0.4; };
  const SurfaceMesh& mesh = run.session.mesh();
  for (const int v : mesh.faces[0].vertex) {
    const Vec3 x = mesh.vertices[v];
    if (!away(x) || x.z() != 0) continue;
    EXPECT_NEAR(run.session.vertex_sizes()[v], 0.02 + std::log(1.3) * (x.x() - 0.1), 0.02);
  }
}

TEST(Facing, AThinBox) {
  for (const double thickness : {0.15, 0.05}) {
    AnalyticCad cad;
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, thickness}, o{};
    cad.faces[1] = plate(o, y, x);
    cad.faces[2] = plate(z, x, y);
    cad.faces[3] = plate(o, x, z);
    cad.faces[4] = plate(y, z, x);
    cad.faces[5] = plate(o, z, y);
    cad.faces[6] = plate(x, y, z);
    const FacingRun run(std::move(cad), 3, 0.3);
    for (const std::size_t face : {0, 1}) expect_sizes(run.sizes(face), thickness / 3, 0.01);
    // Sides are narrow in themselves, up to their corners, where sizes may grow a little.
    for (const std::size_t face : {2, 3, 4, 5}) {
      EXPECT_GE(run.sizes(face)[0], 0.99 * thickness / 3);
      EXPECT_LE(run.sizes(face)[1], 1.04 * thickness / 3);
    }
  }
}

TEST(Facing, CoaxialCylinders) {
  for (const double gap : {0.2, 0.05})
    for (const double h : {0.2, 0.6}) {
      SCOPED_TRACE(std::to_string(gap) + ", h " + std::to_string(h));
      AnalyticCad cad;
      cad.faces[1] = tube(1, 2);
      cad.faces[2] = tube(1 + gap, 2);
      const FacingRun run(std::move(cad), 2, h);
      for (const std::size_t face : {0, 1}) expect_sizes(run.sizes(face), std::min(h, gap / 2), 0.02);
    }
}

TEST(Facing, SizesMayDifferByDirection) {
  const double gap = 0.06;
  AnalyticCad cad;
  cad.faces[1] = tube(1, 2);
  cad.faces[2] = tube(1 + gap, 2);
  const FacingRun run(std::move(cad), 3, 0.5, [](Parameters& p) {
    p.set("hphy_flag", 0);
    p.set("hgeo_flag", 1);
    p.set("geo_metric", 1);
    p.set("hgeomin", 1e-3);
    p.set("hgeomax", 0.5);
  });
  const auto inside = [](Vec3 x) { return x.z() > 0 && x.z() < 2; };
  for (const std::size_t face : {0, 1}) expect_sizes(run.sizes(face, inside), gap / 3, 0.02);
}

}  // namespace
}  // namespace carreau
