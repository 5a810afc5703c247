// Fillets two rows of triangles wide: the vertices of the middle row carry the curvature.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numbers>

#include "session_of_size.h"

namespace carreau {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi;

struct Across {
  int edges = 0;         // inner ones between two vertices of curves
  double deviation = 0;  // of their middles from the surface, the largest
};

/// A quarter of the tube of a torus: a fillet whose borders differ in length.
Across measured(double radius, double size, bool trials) {
  AnalyticCad cad;
  const auto at = [radius](Vec2 p) { return torus_jet(p, radius, 1); };
  cad.faces[1] = {at, rectangle({0, 0}, {pi / 2, pi / 2})};
  Monitor monitor;
  const auto session = session_of_size(cad, size, monitor);
  session->parameters().set("shape_trials", trials ? 1 : 0);
  session->make_mesh();
  const FlatMesh mesh = session->exported();
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  std::vector<char> on_curve(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) ++uses[std::minmax(t[i], t[(i + 1) % 3])];
  for (const auto& [edge, count] : uses)
    if (count == 1) on_curve[edge.first] = on_curve[edge.second] = 1;
  Across all;
  for (const auto& [edge, count] : uses) {
    if (count == 1 || on_curve[edge.first] == 0 || on_curve[edge.second] == 0) continue;
    ++all.edges;
    // Distance to the torus, of the middle of the edge.
    const Vec3 m = 0.5 * (mesh.vertices[edge.first] + mesh.vertices[edge.second]);
    all.deviation = std::max(all.deviation, std::abs(std::hypot(std::hypot(m.x, m.y) - radius, m.z) - 1));
  }
  return all;
}

TEST(MiddleRows, AreNotTradedForShapesByTrials) {
  for (double radius = 2; radius < 20; radius *= 1.3)
    for (double size = 0.7; size < 1.1; size *= 1.03) {
      SCOPED_TRACE(std::to_string(radius) + " " + std::to_string(size));
      const Across without = measured(radius, size, false), with = measured(radius, size, true);
      if (std::getenv("CARREAU_TEST_VERBOSE") != nullptr)
        std::printf("%g %g: %d %g, with trials %d %g\n", radius, size, without.edges, without.deviation, with.edges,
                    with.deviation);
      EXPECT_LE(with.edges, without.edges);
      EXPECT_LE(with.deviation, without.deviation + 1e-9);
    }
}

}  // namespace
}  // namespace carreau
