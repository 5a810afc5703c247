// SPDX-License-Identifier: BSD-3-Clause
// The host's values at points of a face, where it may fail.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cad/cad.h"
#include "support/monitor.h"
#include "surface/sample/face_metric.h"

namespace carreau {

/// Sizes of a metric in the tangent plane.
struct TangentSizes {
  double h = 0;           ///< of the circle with the area of the unit ellipse: sqrt(h1 h2)
  double h1 = 0, h2 = 0;  ///< along the axes of the unit ellipse, h1 <= h2; model length
  double angle = 0;       ///< of the direction of h1 from Su towards Sv, degrees in [0, 180[; 0 where h1 = h2
};

/// Sizes of a metric of the parameter plane, from a jet with first derivatives. All NaN where one of both is degenerate
/// or not finite.
TangentSizes tangent_sizes(const SurfaceJet& jet, Metric2 metric) noexcept;

/// Evaluates many points and goes on if the host fails: missing values are NaN. For one thread.
class FieldSampler {
 public:
  /// `want`: bits of the jets; the bits that `prescribed` (may be null) needs are added. Keeps references.
  FieldSampler(int ref, unsigned want, FaceMetric* prescribed, Cad& cad, Monitor& monitor);

  /// Any size of batch. Metrics are NaN without `prescribed`. Throws Cancelled only. If a host fails at a thousand
  /// points, only some of the following points are evaluated, until it answers.
  void sample(std::span<const Vec2> uv, std::span<SurfaceJet> jets, std::span<Metric2> metric);

  [[nodiscard]] std::int64_t failures() const noexcept { return failures_; }
  [[nodiscard]] const std::string& first_failure() const noexcept { return first_failure_; }

 private:
  /// False when the host fails.
  bool evaluate(unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> jets);
  bool prescribe(std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<Metric2> metric);
  /// Returns false when the host gives neither jet nor metric.
  bool sample_one(Vec2 uv, SurfaceJet& jet, Metric2& metric);
  bool sample_some(std::span<const Vec2> uv, std::span<SurfaceJet> jets, std::span<Metric2> metric);
  void keep(const char* sentence);

  int ref_;
  unsigned want_;
  FaceMetric* prescribed_;
  Cad& cad_;
  Monitor& monitor_;
  std::int64_t failures_ = 0;
  bool failed_ = false;      // at the point at hand
  bool answered_ = false;    // at some point
  std::size_t in_vain_ = 0;  // points evaluated one by one before the first answer
  std::string first_failure_;
};

}  // namespace carreau
