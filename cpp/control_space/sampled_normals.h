// SPDX-License-Identifier: BSD-3-Clause
// Unit normals of a surface, known at samples of its parameters, between them. Private to plane/ and surface/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "control_space/control_space.h"
#include "support/vec.h"

namespace carreau {

/// Collects samples; then, after index(), at() is safe from several threads.
class SampledNormals {
 public:
  /// `normal` of any length; a zero normal (at poles) is ignored. The first some thousand are kept: coarse grids come
  /// first.
  void add(Vec2 uv, Vec3 normal);
  /// Returns whether at least two normals differ.
  [[nodiscard]] bool differ() const noexcept { return differ_; }
  /// Call once, after all add(). `space` measures distances, and must outlive the object.
  void index(const ControlSpace& space);
  /// Unit normal at (u, v): linear least squares about it, of the samples around, the nearest of which weigh most.
  [[nodiscard]] Vec3 at(const Vec2& uv) const noexcept;

 private:
  struct Sample {
    Vec2 uv;
    Vec3 normal;
  };
  class Fit;
  [[nodiscard]] int column(double u) const noexcept;
  [[nodiscard]] int row(double v) const noexcept;
  void gather(Vec2 uv, Metric2 m, double reach, Fit& fit) const noexcept;

  std::vector<Sample> samples_;      // in the order of their buckets, once indexed
  std::vector<std::int32_t> first_;  // of each bucket, row by row
  Vec2 low_{}, scale_{};             // of the samples' box; buckets per parameter
  int side_ = 0;                     // buckets along each side of the box
  double spacing_ = 1;               // of samples, in unit edges, on the average
  const ControlSpace* space_ = nullptr;
  bool differ_ = false;
};

}  // namespace carreau
