// SPDX-License-Identifier: BSD-3-Clause
// Meshes that are uniform in parameter planes (HDR fig. 4.12).
#pragma once

#include "metric/prescription.h"

namespace carreau {

/// Prescribes edges of one length in the parameter plane of each face, whatever their lengths in space. On a curve of several faces the first
/// face counts.
class UniformParameters final : public PrescriptionSource {
 public:
  explicit UniformParameters(double size) : metric_{1 / (size * size), 0, 1 / (size * size)} {}

  [[nodiscard]] bool needs_position() const noexcept override { return false; }
  Prescription on_surface(int, Vec2, Vec3) override { return Prescription::of_parameter(metric_); }
  Prescription on_curve(int, int, double, Vec2, Vec3) override { return Prescription::of_parameter(metric_); }
  Prescription at_point(int, Vec3) override { return {}; }

 private:
  Metric2 metric_;
};

}  // namespace carreau
