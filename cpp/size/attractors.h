// SPDX-License-Identifier: BSD-3-Clause
// Attractors: sizes that grow with the distance from points, edges and triangles.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mesh/simplices/simplex_search.h"
#include "metric/prescription.h"
#include "support/box_tree.h"

namespace carreau {

/// Points, edges and triangles of space, and the sizes around them. The size grows linearly with the distance.
struct Attractor {
  std::vector<Vec3> vertices;                         ///< finite
  std::vector<std::array<std::int32_t, 3>> elements;  ///< indices from 0; an edge is (a, b, b), a point (a, a, a)
  double size = 0;                                    ///< at distance 0
  double surrounding = 0;                             ///< at distance `reach`; at least `size`
  double reach = 0;                                   ///< the attractor gives no answer farther away
};

/// The field of several attractors; the smallest size counts. A place is looked up in logarithmic time.
class Attractors final : public PrescriptionSource {
 public:
  /// Throws InvalidArgument unless there is an element, indices lie in range, coordinates are finite, sizes and the
  /// reach positive and finite, and surrounding >= size.
  void add(const Attractor& attractor);

  [[nodiscard]] std::string name() const override { return "an attractor"; }
  Prescription on_surface(int face, Vec2 uv, Vec3 xyz) override;
  Prescription on_curve(int face, int ic, double t, Vec2 uv, Vec3 xyz) override;
  Prescription at_point(int point, Vec3 xyz) override;
  /// Points of the elements, half a reach apart as far as their number is bounded: surfaces may pass between samples.
  [[nodiscard]] std::span<const SteepPlace> steep_in_space() const override { return steep_; }

 private:
  struct Known {
    BoxTree::Box box;
    SimplexSearch search;
    double size = 0, surrounding = 0, reach = 0;
  };
  [[nodiscard]] Prescription at(const Vec3& p) const noexcept;

  std::vector<Known> known_;
  std::vector<SteepPlace> steep_;
};

}  // namespace carreau
