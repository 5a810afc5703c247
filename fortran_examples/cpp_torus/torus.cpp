// SPDX-License-Identifier: BSD-3-Clause
// Torus of radii 2 and 0.7 by the C++ interface: one face whose sides are sewn to each other by two seams. Its geometry is a lambda for
// many points at a time. The program checks the mesh, and fails if it is wrong.
#include <carreau.hpp>

#include <cmath>
#include <iostream>
#include <numbers>

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

carreau::Geometry torus(double big, double small) {
  return {
      .surface_order = 1, // second derivatives by finite differences
      .curve_order = 1,
      .reentrant = true,
      .surface_batch =
          [=](int, std::span<const carreau::Point2> uv, int order, const carreau::SurfaceRows& out) {
            for (std::size_t i = 0; i < uv.size(); ++i) {
              const double cu = std::cos(uv[i][0]), su = std::sin(uv[i][0]);
              const double x = small * std::cos(uv[i][1]), z = small * std::sin(uv[i][1]), w = big + x;
              out.s[i] = {w * cu, w * su, z};
              if (order < 1) continue;
              out.su[i] = {-w * su, w * cu, 0};
              out.sv[i] = {-z * cu, -z * su, x};
            }
          },
      .curve_interval = [](int, int) -> carreau::Interval { return {0, kTwoPi}; },
      // 1: v = 0, 2: u = 2 pi, 3: v = 2 pi, 4: u = 0. Both sides of a seam run the same way.
      .curve = [](int, int ic, double t, int) -> carreau::CurvePoint {
        const double other = ic == 2 || ic == 3 ? kTwoPi : 0;
        if (ic == 1 || ic == 3) return {.c = {t, other}, .ct = {1, 0}};
        return {.c = {other, t}, .ct = {0, 1}};
      },
  };
}

int run() {
  carreau::Session session;
  session.set_geometry(torus(2, 0.7));
  session.add_face(1);
  for (int side = 0; side < 4; ++side) session.add_curve(1, {.ref = side % 2 + 1, .ends = {1, 1}});
  session.set("hphydef", 0.1);
  session.on_progress([](int, int, double fraction) {
    std::clog << '\r' << static_cast<int>(100 * fraction) << " %" << std::flush;
    return true; // false would stop the run
  });
  session.generate();
  std::clog << '\n';

  const carreau::Mesh mesh = session.mesh();
  const carreau_quality quality = mesh.quality();
  const double area = kTwoPi * 2 * kTwoPi * 0.7;
  std::cout << mesh.vertex_count() << " vertices, " << mesh.triangle_count() << " triangles, area " << quality.area << " of " << area
            << ", Q2 " << quality.q2_mean << ", worst " << quality.q2_min << '\n';
  mesh.write("torus.vtu");
  for (const std::string& defect : mesh.defects(/*closed=*/true)) std::cerr << defect << '\n';
  const bool on_torus = std::ranges::all_of(mesh.vertices(), [](const carreau::Point3& p) {
    return std::abs(std::hypot(std::hypot(p[0], p[1]) - 2, p[2]) - 0.7) < 1e-14;
  });
  const bool good = on_torus && mesh.defects(true).empty() && std::abs(quality.area / area - 1) < 0.1 * 0.1 / (4 * 0.7 * 0.7) &&
                    quality.q2_mean > 0.985 && quality.q2_min > 0.6;
  return good ? 0 : 1;
}

} // namespace

int main() {
  try {
    return run();
  } catch (const carreau::Error& error) { // the sentence names face, curve and parameters; error.place() has them as numbers
    std::cerr << error.status_name() << ": " << error.what() << '\n';
    return 1;
  }
}
