// SPDX-License-Identifier: BSD-3-Clause
// The heights of all charts as one surface, whatever the parameters of a place are.
#pragma once

#include "geometry/atlas/height_field.h"

namespace carreau::atlas {

/// Moves points of space onto the heights of the charts around. The weight of a chart is the sum of bumps about the vertices of its cluster,
/// so it depends on the point alone: where charts squeeze their parameters, weights change no faster in space than elsewhere.
class HeightBlend {
 public:
  explicit HeightBlend(const Covering& covering);

  /// Charts whose weights can be above zero at a chart, or at a T.
  [[nodiscard]] const std::vector<std::int32_t>& near_chart(std::size_t chart) const { return near_chart_[chart]; }
  [[nodiscard]] const std::vector<std::int32_t>& near_triple(std::size_t triple) const { return near_triple_[triple]; }

  /// x on the blended heights; beside all bumps, on the height of `own`.
  template <typename Number>
  [[nodiscard]] std::array<Number, 3> onto(const std::vector<std::int32_t>& charts, std::size_t own, const std::array<Number, 3>& x) const;

  /// The unit direction along which onto() moves points near x: the mean of the charts' normals.
  [[nodiscard]] Vec3 direction(const std::vector<std::int32_t>& charts, std::size_t own, const Vec3& x) const;

 private:
  /// (1 - (r / radius)^2)^3: C2.
  struct Bump {
    Vec3 centre{0, 0, 0};
    double radius = 0;
  };

  template <typename Number>
  [[nodiscard]] Number weight(std::size_t chart, const std::array<Number, 3>& x) const;
  /// How far x is below the height of the chart.
  template <typename Number>
  [[nodiscard]] Number missing(std::size_t chart, const std::array<Number, 3>& x) const;

  std::vector<Frame> frames_;
  std::vector<HeightField> heights_;
  std::vector<std::vector<Bump>> bumps_;
  std::vector<Bump> around_;  ///< by chart: a ball that holds its bumps
  std::vector<std::vector<std::int32_t>> near_chart_, near_triple_;
};

template <typename Number>
Number HeightBlend::weight(std::size_t chart, const std::array<Number, 3>& x) const {
  const Vec3 at(value_of(x[0]), value_of(x[1]), value_of(x[2]));
  Number sum = 0.0;
  const auto inside = [&](const Bump& bump) { return (at - bump.centre).squaredNorm() < bump.radius * bump.radius; };
  if (!inside(around_[chart])) return sum;
  for (const Bump& bump : bumps_[chart]) {
    if (!inside(bump)) continue;
    const Number dx = x[0] - bump.centre.x(), dy = x[1] - bump.centre.y(), dz = x[2] - bump.centre.z();
    const Number rest = 1.0 - (dx * dx + dy * dy + dz * dz) / (bump.radius * bump.radius);
    sum = sum + rest * rest * rest;
  }
  return sum;
}

template <typename Number>
Number HeightBlend::missing(std::size_t chart, const std::array<Number, 3>& x) const {
  const Frame& frame = frames_[chart];
  const auto along = [&](const Vec3& axis) {
    return Number(axis.x() * (x[0] - frame.origin.x()) + axis.y() * (x[1] - frame.origin.y()) +
                  axis.z() * (x[2] - frame.origin.z()));
  };
  return heights_[chart].at(Pair<Number>{along(frame.u), along(frame.v)}) - along(frame.normal);
}

template <typename Number>
std::array<Number, 3> HeightBlend::onto(const std::vector<std::int32_t>& charts, std::size_t own, const std::array<Number, 3>& x) const {
  Number total = 0.0;
  std::array<Number, 3> moved{Number(0.0), Number(0.0), Number(0.0)};
  const auto add = [&](std::size_t chart, const Number& w) {
    const Number d = w * missing(chart, x);
    const Vec3& n = frames_[chart].normal;
    total = total + w;
    for (int i = 0; i < 3; ++i) moved[static_cast<std::size_t>(i)] = moved[static_cast<std::size_t>(i)] + n[i] * d;
  };
  for (const std::int32_t c : charts) {
    const Number w = weight(static_cast<std::size_t>(c), x);
    if (value_of(w) > 0) add(static_cast<std::size_t>(c), w);
  }
  if (!(value_of(total) > 0)) add(own, Number(1.0));
  return {x[0] + moved[0] / total, x[1] + moved[1] / total, x[2] + moved[2] / total};
}

}  // namespace carreau::atlas
