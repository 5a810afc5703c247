// SPDX-License-Identifier: BSD-3-Clause
// A torus whose hole is ten thousand times narrower than its tube: around the waist sizes change manifold along edges.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "session_of_size.h"

namespace carreau {
namespace {

using namespace testing;

// Meshes of 11 000 to 14 000 triangles, whose fields bend.
TEST(Waists, HaveNoTrianglesAcross) {
  constexpr double pi = std::numbers::pi;
  for (double share = 66; share < 74; share *= 1.006) {
    SCOPED_TRACE(std::to_string(share));
    AnalyticCad cad;
    const auto at = [](Vec2 p) { return torus_jet(p, 1 + 1e-4, 1); };
    cad.faces[1] = {at, rectangle({0, 0}, {2 * pi, 2 * pi})};
    Monitor monitor;
    const auto session = session_of_command(cad, 6 / share, monitor);
    session->make_mesh();
    const FlatMesh mesh = session->exported();
    const double worst = worst_q2(mesh);
    if (std::getenv("CARREAU_TEST_VERBOSE") != nullptr)
      std::printf("%g: %zu triangles, worst %.4f\n", share, mesh.triangles.size(), worst);
    EXPECT_GE(worst, 0.02);
  }
}

}  // namespace
}  // namespace carreau
