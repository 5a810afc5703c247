// SPDX-License-Identifier: BSD-3-Clause
// Meshes free of patches are within the tolerances of A0 and A1, by upper bounds: where sizes are as large as the surface bends, too.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "euler_number.h"
#include "independent/patchworks.h"
#include "mesh/surface_mesh.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using namespace testing;

constexpr double pi = std::numbers::pi;

std::unique_ptr<Session> meshed(const AnalyticCad& cad, double size, int certify, int threads = 1) {
  static Monitor quiet;
  auto session = session_of_size(cad, size, quiet);
  session->parameters().set("patches", "independent");
  session->parameters().set("certify", certify);
  session->parameters().set("threads", threads);
  session->make_mesh();
  return session;
}

const Delivery& shares(Session& session) { return session.delivered()[EvaluationKind::bound_share]; }

void expect_no_worse(const Session& made, const Session& before) {
  EXPECT_TRUE(find_defects(made.mesh()).empty());
  EXPECT_EQ(euler_number(made.mesh()), euler_number(before.mesh()));
}

/// Of radius 1 around the axis, cut into 12 by 8 patches.
AnalyticCad torus_of_patches(double tube) {
  AnalyticCad cad;
  add_grid(
      cad, 1,
      [tube](Vec2 p) {
        const double c = std::cos(p.x()), s = std::sin(p.x()), a = tube * std::cos(p.y()), b = tube * std::sin(p.y()), r = 1 + a;
        return SurfaceJet{{r * c, r * s, b}, {-r * s, r * c, 0}, {-b * c, -b * s, a}, {-r * c, -r * s, 0}, {b * s, -b * c, 0}, {-a * c, -a * s, -b}};
      },
      {0, 0}, {2 * pi, 2 * pi}, 12, 8);
  return cad;
}

/// Apex at the origin, height 4, open; cut from the apex on.
AnalyticCad cone_of_strips(double radius, int strips) {
  AnalyticCad cad;
  const double k = radius / 4;
  add_grid(
      cad, 1,
      [k](Vec2 p) {
        const double c = k * std::cos(p.x()), s = k * std::sin(p.x()), v = p.y();
        return SurfaceJet{{v * c, v * s, v}, {-v * s, v * c, 0}, {c, s, 1}, {-v * c, -v * s, 0}, {-s, c, 0}, {0, 0, 0}};
      },
      {0, 0}, {2 * pi, 4}, strips, 1);
  return cad;
}

TEST(Certification, ThinTorus) {
  for (const double size : {0.25, 0.3}) {
    const AnalyticCad cad = torus_of_patches(0.2);
    const auto before = meshed(cad, size, 0), made = meshed(cad, size, 1);
    printf("torus %g: %ld %g -> %ld %g of %zu\n", size, long(shares(*before).beyond), shares(*before).spread.max, long(shares(*made).beyond), shares(*made).spread.max, made->mesh().triangle_count());
    EXPECT_EQ(shares(*made).beyond, 0);
    expect_no_worse(*made, *before);
  }
}

TEST(Certification, ApexOfACone) {
  for (const double radius : {0.6, 1.2, 2.}) {
    const AnalyticCad cad = cone_of_strips(radius, 4);
    const auto before = meshed(cad, 0.3, 0), made = meshed(cad, 0.3, 1);
    printf("cone %g: %ld %g -> %ld %g of %zu\n", radius, long(shares(*before).beyond), shares(*before).spread.max, long(shares(*made).beyond), shares(*made).spread.max, made->mesh().triangle_count());
    EXPECT_EQ(shares(*made).beyond, 0);
    expect_no_worse(*made, *before);
  }
}

TEST(Certification, CylinderAndSphere) {
  for (const double size : {0.8, 1.0, 1.2, 1.4}) {
    const auto before = meshed(cylinder_of_strips(24), size, 0), made = meshed(cylinder_of_strips(24), size, 1);
    printf("cylinder %g: %ld %g -> %ld %g of %zu\n", size, long(shares(*before).beyond), shares(*before).spread.max, long(shares(*made).beyond), shares(*made).spread.max, made->mesh().triangle_count());
    expect_no_worse(*made, *before);
    const auto sphere = meshed(sphere_of_triangles(2), size, 0), better = meshed(sphere_of_triangles(2), size, 1);
    printf("sphere %g: %ld %g -> %ld %g of %zu\n", size, long(shares(*sphere).beyond), shares(*sphere).spread.max, long(shares(*better).beyond), shares(*better).spread.max, better->mesh().triangle_count());
    expect_no_worse(*better, *sphere);
  }
}

}  // namespace
}  // namespace carreau
