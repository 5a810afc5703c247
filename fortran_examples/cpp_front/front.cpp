// SPDX-License-Identifier: BSD-3-Clause
// A front across a square by the C++ interface. The mesh is adapted to a field that is known by values, by direction. The field's
// error of interpolation is compared with its error on the first mesh. The domain is given by arrays, without callbacks.
#include <carreau.hpp>

#include <cmath>
#include <iostream>

namespace {

double front(const carreau::Point3& p) { return std::tanh(20 * (p[1] - 0.5 - 0.2 * std::sin(6 * p[0]))); }

void add_square(carreau::Session& session) {
  const std::array<double, 8> points{0, 0, 1, 0, 1, 1, 0, 1};
  const std::array<std::int64_t, 2> starts{0, 5};
  const std::array<std::int32_t, 5> corners{0, 1, 2, 3, 0};
  carreau_plane_domain square{};
  square.point_count = 4;
  square.points = points.data();
  square.curve_count = 1;
  square.curve_starts = starts.data();
  square.curve_points = corners.data();
  carreau::add_plane_domain(session, square);
}

int run() {
  carreau::Session session;
  add_square(session);
  session.set("hphydef", 0.1);
  session.set("gradation", 2.0);

  carreau::Adaptation adaptation;
  adaptation.estimator.source = CARREAU_HESSIAN;
  adaptation.estimator.shape = CARREAU_ANISOTROPIC;
  adaptation.estimator.tolerance = 0.01;
  adaptation.estimator.hmin = 1e-3;
  adaptation.estimator.hmax = 0.2;
  adaptation.iterations = 6;
  adaptation.field = [](std::span<const carreau::Point3> points, std::span<double> values) {
    std::ranges::transform(points, values.begin(), front);
  };
  const carreau_adaptation_report report = carreau::adapt(session, adaptation).report;

  const carreau::Mesh mesh = session.mesh();
  std::cout << report.triangles_before << " triangles with an error of " << report.error_max_before << ", then " << report.triangles
            << " with " << report.error_max << ", stretched up to " << report.stretch_max << " : 1\n";
  mesh.write("front.mesh");
  const bool good = mesh.defects().empty() && report.error_max < 0.1 * report.error_max_before && report.stretch_max > 3;
  return good ? 0 : 1;
}

} // namespace

int main() {
  try {
    return run();
  } catch (const carreau::Error& error) {
    std::cerr << error.status_name() << ": " << error.what() << '\n';
    return 1;
  }
}
