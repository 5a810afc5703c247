// SPDX-License-Identifier: BSD-3-Clause
// Heights about all vertices as one surface, whatever the parameters of a place are.
#pragma once

#include "geometry/atlas/height_field.h"

namespace carreau::atlas {

/// Moves points of space onto heights about the vertices around. Each vertex has a height field of its own, which
/// counts inside an ellipsoid about the vertex: a field is never evaluated far from its vertex, and weights change no
/// faster in space where charts squeeze their parameters.
class HeightBlend {
 public:
  explicit HeightBlend(const Covering& covering);

  /// Vertices whose weights can be above zero at a chart, or at a T.
  [[nodiscard]] const std::vector<std::int32_t>& near_chart(std::size_t chart) const { return near_chart_[chart]; }
  [[nodiscard]] const std::vector<std::int32_t>& near_triple(std::size_t triple) const { return near_triple_[triple]; }

  /// x on the blended heights of the vertices; beside all ellipsoids, on the height of the nearest one.
  template <typename Number>
  [[nodiscard]] std::array<Number, 3> onto(const std::vector<std::int32_t>& vertices,
                                           const std::array<Number, 3>& x) const;

  /// The unit direction along which onto() moves points near x: the mean of the vertices' normals.
  [[nodiscard]] Vec3 direction(const std::vector<std::int32_t>& vertices, const Vec3& x) const;

 private:
  /// Calls use(heights, coordinates, weight) for each vertex whose ellipsoid holds x.
  template <typename Number, typename Use>
  void visit(const std::vector<std::int32_t>& vertices, const std::array<Number, 3>& x, Use&& use) const;
  [[nodiscard]] std::size_t nearest(const std::vector<std::int32_t>& vertices, const Vec3& x) const;
  /// Coordinates of x in the frame of a vertex.
  template <typename Number>
  [[nodiscard]] static std::array<Number, 3> seen_from(const Frame& frame, const std::array<Number, 3>& x);

  std::vector<LocalHeights> around_;  ///< by vertex
  std::vector<std::vector<std::int32_t>> near_chart_, near_triple_;
};

template <typename Number>
std::array<Number, 3> HeightBlend::seen_from(const Frame& frame, const std::array<Number, 3>& x) {
  const auto along = [&](const Vec3& axis) {
    return Number(axis.x() * (x[0] - frame.origin.x()) + axis.y() * (x[1] - frame.origin.y()) +
                  axis.z() * (x[2] - frame.origin.z()));
  };
  return {along(frame.u), along(frame.v), along(frame.normal)};
}

template <typename Number, typename Use>
void HeightBlend::visit(const std::vector<std::int32_t>& vertices, const std::array<Number, 3>& x, Use&& use) const {
  const Vec3 at(value_of(x[0]), value_of(x[1]), value_of(x[2]));
  for (const std::int32_t v : vertices) {
    const LocalHeights& local = around_[static_cast<std::size_t>(v)];
    if (!((at - local.frame.origin).squaredNorm() < local.reach * local.reach)) continue;
    const std::array<Number, 3> p = seen_from(local.frame, x);
    const auto& form = local.form;
    const Number rest =
        1.0 - (form[0] * p[0] * p[0] + form[1] * p[0] * p[1] + form[2] * p[1] * p[1] + form[3] * p[2] * p[2]);
    if (value_of(rest) > 0) use(local, p, Number(rest * rest * rest));
  }
}

template <typename Number>
std::array<Number, 3> HeightBlend::onto(const std::vector<std::int32_t>& vertices,
                                        const std::array<Number, 3>& x) const {
  Number total = 0.0;
  std::array<Number, 3> moved{Number(0.0), Number(0.0), Number(0.0)};
  const auto add = [&](const LocalHeights& local, const std::array<Number, 3>& p, const Number& weight) {
    const Number d = weight * (local.field.at(Pair<Number>{p[0], p[1]}) - p[2]);
    total = total + weight;
    for (std::size_t i = 0; i < 3; ++i) moved[i] = moved[i] + local.frame.normal[static_cast<int>(i)] * d;
  };
  visit(vertices, x, add);
  if (!(value_of(total) > 0)) {
    const LocalHeights& local = around_[nearest(vertices, Vec3(value_of(x[0]), value_of(x[1]), value_of(x[2])))];
    add(local, seen_from(local.frame, x), Number(1.0));
  }
  return {x[0] + moved[0] / total, x[1] + moved[1] / total, x[2] + moved[2] / total};
}

}  // namespace carreau::atlas
