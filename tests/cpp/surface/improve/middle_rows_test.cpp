// SPDX-License-Identifier: BSD-3-Clause
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
  double penalty = 0;    // sum over triangles of Q2^-6 - 1
  double turn = 0;       // of the surface along any inner edge, degrees, the largest
};

/// Unit normal of the torus of the larger radius `radius` at a place on it.
Vec3 torus_normal(Vec3 p, double radius) {
  const double r = std::hypot(p.x(), p.y());
  const Vec3 n{p.x() * (1 - radius / r), p.y() * (1 - radius / r), p.z()};
  return (1 / norm(n)) * n;
}

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
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = mesh.vertices[a], q = mesh.vertices[b], r = mesh.vertices[c];
    const double lengths2 = dot(q - p, q - p) + dot(r - q, r - q) + dot(p - r, p - r);
    all.penalty += std::pow(2 * std::sqrt(3) * norm(cross(q - p, r - p)) / lengths2, -6) - 1;
  }
  for (const auto& [edge, count] : uses) {
    if (count == 1) continue;
    const Vec3 n = torus_normal(mesh.vertices[edge.first], radius),
               m = torus_normal(mesh.vertices[edge.second], radius);
    all.turn = std::max(all.turn, 360 / pi * std::asin(std::min(norm(n - m) / 2, 1.0)));
    if (on_curve[edge.first] == 0 || on_curve[edge.second] == 0) continue;
    ++all.edges;
    // Distance to the torus, of the middle of the edge.
    const Vec3 middle = 0.5 * (mesh.vertices[edge.first] + mesh.vertices[edge.second]);
    all.deviation =
        std::max(all.deviation, std::abs(std::hypot(std::hypot(middle.x(), middle.y()) - radius, middle.z()) - 1));
  }
  return all;
}

TEST(MiddleRows, AreNotTradedForShapesByTrials) {
  for (double radius = 2; radius < 20; radius *= 1.3)
    for (double size = 0.7; size < 1.1; size *= 1.03) {
      SCOPED_TRACE(std::to_string(radius) + " " + std::to_string(size));
      const Across without = measured(radius, size, false), with = measured(radius, size, true);
      if (std::getenv("CARREAU_TEST_VERBOSE") != nullptr)
        std::printf("%g %g: %d %g %g, with trials %d %g %g\n", radius, size, without.edges, without.deviation,
                    without.turn, with.edges, with.deviation, with.turn);
      EXPECT_LE(with.edges, without.edges);
      EXPECT_LE(with.deviation, without.deviation + 1e-9);
      // Chords across the whole fillet leave shapes in space that differ from the shapes in the plane.
      if (size < 0.95) {
        EXPECT_LE(with.penalty, without.penalty * (1 + 1e-6));
      }
      EXPECT_LE(with.turn, std::max(without.turn, 20.0) + 2);  // normals between samples err by up to 1
    }
}

}  // namespace
}  // namespace carreau
