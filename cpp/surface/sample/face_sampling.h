// SPDX-License-Identifier: BSD-3-Clause
// The metric of a face, sampled over its domain.
#pragma once

#include <span>
#include <vector>

#include "control_space/sampled_normals.h"
#include "support/infinity.h"
#include "surface/patch.h"

namespace carreau {

/// Properties of a face that samples show beside its metric.
struct SampledFacts {
  SampledNormals* normals = nullptr;  ///< gets the normals at the samples, if given
  bool isotropic = true;              ///< sizes do not differ by direction at any of them
  /// Stops with UnevenSpeed if a derivative is `max_uneven` times as long as usual. `usual_speed`: the usual length;
  /// 0: the length along that parameter at the first samples.
  double usual_speed = 0;
  double max_uneven = infinity;
};

/// A place where the parametrisation is far faster than elsewhere. Not an error: sampling starts again in others.
struct UnevenSpeed {
  Vec2 uv;
  double times;  ///< as fast
};

/// Compares lengths of derivatives at the first samples, all over the domain, with lengths at later samples.
class SpeedWatch {
 public:
  /// Takes SampledFacts::max_uneven and usual_speed.
  SpeedWatch(double most, double usual) : most2_(most * most), usual_u2_(usual * usual), usual_v2_(usual_u2_) {}
  /// Throws UnevenSpeed.
  void look(std::span<const Vec2> uv, std::span<const SurfaceJet> jets);

 private:
  void find_usual(std::span<const SurfaceJet> jets);

  double most2_, usual_u2_, usual_v2_;
};

/// Samples the metric of a face (FaceMetric) over its domain, within input.limits. `probe_points`: see
/// ControlSpaceOptions.
ControlSpace sample_face(const PatchInput& input, Cad& cad, const SizeRules& rules, std::span<const Vec2> probe_points,
                         Monitor& monitor, SampledFacts* facts = nullptr);

/// Sizes in the mean, sqrt(h1 h2), that FaceMetric prescribes within input.limits.
std::vector<double> prescribed_sizes(const PatchInput& input, Cad& cad, const SizeRules& rules,
                                     std::span<const Vec2> uv, Monitor& monitor);

}  // namespace carreau
