// SPDX-License-Identifier: BSD-3-Clause
// Tongues of faces that end where a curve touches another curve: their tips are as narrow as the tongues are long.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "session_of_size.h"

namespace carreau {
namespace {

using namespace testing;

/// A plane whose boundary comes down an arc to the origin, goes up the v axis to (0, l), where it turns and goes down
/// an arc of radius r: the face has a tongue between the two.
AnalyticCad tongue(double l, double r) {
  constexpr double pi = std::numbers::pi;
  const double upper = 4 * r;
  AnalyticCad cad;
  const auto plane = [](Vec2 p) { return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; };
  const Vec2 left{-r, l - r}, bottom{-r, -1}, right{1, -1}, top{1, upper};
  cad.faces[1] = {plane,
                  {segment(left, bottom), segment(bottom, right), segment(right, top), segment(top, {upper, upper}),
                   arc({upper, 0}, upper, pi / 2, pi), segment({0, 0}, {0, l}), arc({-r, l}, r, 0, -pi / 2)}};
  return cad;
}

// A triangle between both ends of the straight side and the point of the arc beside its lower one has a height of
// l^2 / (2 r): Q2 is sqrt(3) l / (2 r), about, as the vertex is where edges end. Edges cut shorter would make the tip
// worse, in proportion.
TEST(Tongues, AreNotCutToTheirTips) {
  for (const double r : {0.1, 0.15})
    for (double l = 0.008; l < 0.03; l *= 1.3)
      for (double size = 0.04; size < 0.09; size *= 1.2) {
        SCOPED_TRACE(std::to_string(r) + " " + std::to_string(l) + " " + std::to_string(size));
        const AnalyticCad cad = tongue(l, r);
        Monitor monitor;
        const auto session = session_of_command(cad, size, monitor);
        session->make_mesh();
        const FlatMesh mesh = session->exported();
        const double worst = worst_q2(mesh);
        if (std::getenv("CARREAU_TEST_VERBOSE") != nullptr)
          std::printf("r %g, l %g, size %g: %zu triangles, worst %.4f of %.4f\n", r, l, size, mesh.triangles.size(),
                      worst, std::sqrt(3) * l / (2 * r));
        EXPECT_GE(worst, 0.85 * std::sqrt(3) * l / (2 * r));
      }
}

}  // namespace
}  // namespace carreau
