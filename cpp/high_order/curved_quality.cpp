// SPDX-License-Identifier: BSD-3-Clause
#include "high_order/curved_quality.h"

#include <algorithm>
#include <optional>
#include <span>

#include "high_order/thresholds.h"

namespace carreau {

namespace {

/// Tangents of an element at places, as sums of its nodes.
struct Tangents {
  std::vector<double> by_s, by_t, weight;  // rows by place

  // Gauss's rule of 6 x 6 points; triangles have the square's with one side drawn together.
  explicit Tangents(const ElementShape& shape) {
    constexpr double abscissae[]{0.2386191860831969, 0.6612093864662645, 0.9324695142031521},
        weights[]{0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
    std::vector<Vec2> places;
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 6; ++k) {
        const double s = (1 + (i % 2 == 0 ? 1 : -1) * abscissae[i / 2]) / 2, t = (1 + (k % 2 == 0 ? 1 : -1) * abscissae[k / 2]) / 2;
        const double w = weights[i / 2] * weights[k / 2] / 4;
        places.push_back(shape.is_quad() ? Vec2(s, t) : Vec2(s * (1 - t), t));
        weight.push_back(shape.is_quad() ? w : w * (1 - t));
      }
    by_s = derivatives(shape, places, {1, 0}), by_t = derivatives(shape, places, {0, 1});
  }

  // Differences of five points are exact up to degree 4.
  static std::vector<double> derivatives(const ElementShape& shape, const std::vector<Vec2>& places, const Vec2& direction) {
    constexpr double step = 0.25;
    std::vector<double> sum(places.size() * shape.node_count(), 0);
    for (const auto& [offset, factor] : {std::pair(-2, 1.), {-1, -8.}, {1, 8.}, {2, -1.}}) {
      std::vector<Vec2> moved;
      for (const Vec2& place : places) moved.push_back(place + offset * step * direction);
      const std::vector<double> values = shape.values_at(moved);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor / (12 * step) * values[i];
    }
    return sum;
  }

  [[nodiscard]] double area(std::span<const Vec3> x) const {
    double all = 0;
    for (std::size_t q = 0; q < weight.size(); ++q) {
      Vec3 s(0, 0, 0), t(0, 0, 0);
      for (std::size_t k = 0; k < x.size(); ++k) s += by_s[q * x.size() + k] * x[k], t += by_t[q * x.size() + k] * x[k];
      all += weight[q] * norm(cross(s, t));
    }
    return all;
  }
};

/// Calls use(shape, nodes) for each element: triangles, then quadrilaterals.
template <typename Use>
void for_elements(const HighOrderMesh& mesh, const Use& use) {
  for (const bool quad : {false, true}) {
    const std::vector<std::int32_t>& rows = quad ? mesh.quads : mesh.triangles;
    if (rows.empty()) continue;
    const ElementShape shape(quad, mesh.order, mesh.places);
    std::vector<Vec3> x(shape.node_count());
    for (std::size_t row = 0; row < rows.size(); row += x.size()) {
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = mesh.nodes[rows[row + i]];
      use(shape, x);
    }
  }
}

bool is_valid(double least) { return least >= thresholds::high_order::least_jacobian; }

}  // namespace

CurvedQuality measure_curved(const HighOrderMesh& mesh) {
  CurvedQuality quality;
  double sum = 0;
  std::size_t count = 0;
  std::optional<Tangents> tangents;
  bool of_quads = false;
  for_elements(mesh, [&](const ElementShape& shape, const std::vector<Vec3>& x) {
    if (!tangents || shape.is_quad() != of_quads) tangents.emplace(shape), of_quads = shape.is_quad();
    const double least = shape.least_jacobian(x);
    sum += least, ++count, quality.least_jacobian_min = std::min(quality.least_jacobian_min, least);
    if (!is_valid(least)) ++quality.invalid;
    quality.area += tangents->area(x);
  });
  if (count > 0) quality.least_jacobian_mean = sum / static_cast<double>(count);
  return quality;
}

std::vector<std::string> find_curved_defects(const HighOrderMesh& mesh) {
  std::vector<std::string> defects;
  std::size_t element = 0;
  for_elements(mesh, [&](const ElementShape& shape, const std::vector<Vec3>& x) {
    if (!is_valid(shape.least_jacobian(x)))
      defects.push_back("element " + std::to_string(element) + " of order " + std::to_string(mesh.order) + ": its Jacobian is not positive everywhere");
    ++element;
  });
  return defects;
}

}  // namespace carreau
