// SPDX-License-Identifier: BSD-3-Clause
// The mesh of a square by the installed headers for C++.
#include <carreau.hpp>

#include <cmath>
#include <iostream>

int main() try {
  carreau::Session session;
  const carreau::BezierPatch square{.m = 1, .n = 1, .controls = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}}};
  carreau::add_bezier(session, std::span(&square, 1));
  session.set("hphydef", 0.1);
  session.generate();
  const carreau::Mesh mesh = session.mesh();
  std::cout << mesh.triangle_count() << " triangles\n";
  return mesh.triangle_count() > 150 && std::abs(mesh.quality().area - 1) < 1e-12 && mesh.defects().empty() ? 0 : 1;
} catch (const carreau::Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
