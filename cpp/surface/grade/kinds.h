// SPDX-License-Identifier: BSD-3-Clause
// Sizes that are the same in all directions, and sizes that are not: what the drivers of size_grading ask of either.
// Private to this room.
#pragma once

#include <vector>

#include "surface/grade/grading_work.h"

namespace carreau::detail {

/// One size at each vertex (h-correction). Keeps a reference to the work.
class IsotropicGrading {
 public:
  explicit IsotropicGrading(GradingWork& work) : work_(work) {}

  void run(const std::vector<SizeSamples>& raw, double slope);
  /// The graded size at a place of the graph along a unit vector, which does not matter here.
  [[nodiscard]] double along(int place, const Vec3& direction) const noexcept;
  /// Hands the graded sizes of a face over to it, and marks where what was prescribed does not obey.
  void give_to_face(std::size_t face);
  /// Along a curve at a node of the graph; and at a share `w` of the way to the next one, where `h` lies between the
  /// sizes at both and the curve knows of `known`.
  [[nodiscard]] double at_node(std::size_t curve, std::size_t node, const SizeSamples& raw) const;
  [[nodiscard]] double between_nodes(std::size_t curve, std::size_t node, double w, double h, double known,
                                     const GradedField& field) const;

 private:
  GradingWork& work_;
  GradationFronts fronts_;
};

/// A metric at each place (Hc-correction); members as above.
class DirectionalGrading {
 public:
  explicit DirectionalGrading(GradingWork& work) : work_(work) {}

  void run(const std::vector<SizeSamples>& raw, double slope);
  [[nodiscard]] double along(int place, const Vec3& direction) const noexcept;
  void give_to_face(std::size_t face);
  [[nodiscard]] double at_node(std::size_t curve, std::size_t node, const SizeSamples& raw) const;
  [[nodiscard]] double between_nodes(std::size_t curve, std::size_t node, double w, double h, double known,
                                     const GradedField& field) const;

 private:
  GradingWork& work_;
};

}  // namespace carreau::detail
