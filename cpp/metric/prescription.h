// SPDX-License-Identifier: BSD-3-Clause
// Prescriptions of a host, a background mesh or an estimator: the size or metric at one place.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "metric/metric2_algebra.h"
#include "metric/metric3.h"
#include "support/vec.h"

namespace carreau {

/// An answer, or none. Values are unchecked: their users check that they are finite and positive definite, and clamp
/// them.
struct Prescription {
  enum class Kind {
    none,       ///< no answer here
    size,       ///< an isotropic size in space
    space,      ///< a metric of space
    parameter,  ///< a metric of the parameter plane of the face at hand
  };
  Kind kind = Kind::none;
  double size = 0;
  Metric3 space;
  Metric2 parameter;

  static Prescription of_size(double h) noexcept {
    return {.kind = Kind::size, .size = h, .space = {}, .parameter = {}};
  }
  static Prescription of_space(const Metric3& m) noexcept {
    return {.kind = Kind::space, .size = 0, .space = m, .parameter = {}};
  }
  static Prescription of_parameter(Metric2 m) noexcept {
    return {.kind = Kind::parameter, .size = 0, .space = {}, .parameter = m};
  }
};

/// A place of space beside which a field varies more than samples of its surroundings show.
struct SteepPlace {
  Vec3 at;
  double reach = 0;  ///< surfaces and curves that pass it at this distance may have the place
};

/// A field of prescribed sizes or metrics: a host's metric callbacks, a background mesh, an estimator's result. Called
/// from the thread of the run only.
class PrescriptionSource {
 public:
  virtual ~PrescriptionSource() = default;
  /// Its name in sentences about unusable answers.
  [[nodiscard]] virtual std::string name() const { return "the prescription of sizes"; }
  /// False: `xyz` is never read, and need not be evaluated.
  [[nodiscard]] virtual bool needs_position() const noexcept { return true; }
  /// Called before a run; `law`: the variation of values between known places (hinterpol_flag).
  virtual void begin_run(MetricLaw /*law*/) {}
  /// Sentences about the run that is over, as messages.
  [[nodiscard]] virtual std::vector<std::string> remarks() const { return {}; }
  /// Relative error of lengths in the field: sampling need not be finer. Below 0.01: as if 0.01.
  [[nodiscard]] virtual double accuracy() const noexcept { return 0; }
  /// Places of a face's parameter plane near which the field varies more than samples of its surroundings show.
  [[nodiscard]] virtual std::vector<Vec2> steep_places(int /*face*/) const { return {}; }
  /// Steep places of fields that know space only.
  [[nodiscard]] virtual std::span<const SteepPlace> steep_in_space() const { return {}; }
  /// Parameters of a curve at which the field along it has a kink, and between which it is as exact as its law. The field
  /// is sampled at these, and finely between. Empty: nothing is known.
  [[nodiscard]] virtual std::vector<double> kinks_on_curve(int /*face*/, int /*ic*/) const { return {}; }
  /// True: the source prescribes curves and points alone, and each face interpolates the sizes of its boundary.
  [[nodiscard]] virtual bool curves_only() const noexcept { return false; }
  /// Inside a face (its reference) at (u, v), whose image is `xyz`.
  virtual Prescription on_surface(int face, Vec2 uv, Vec3 xyz) = 0;
  /// Evaluates several points of one face. All spans have one size.
  virtual void on_surface_points(int face, std::span<const Vec2> uv, std::span<const Vec3> xyz,
                                 std::span<Prescription> out) {
    for (std::size_t i = 0; i < uv.size(); ++i) out[i] = on_surface(face, uv[i], xyz[i]);
  }
  /// On a curve (rank `ic` from 1 in that face) at t.
  virtual Prescription on_curve(int face, int ic, double t, Vec2 uv, Vec3 xyz) = 0;
  /// At a point (its reference).
  virtual Prescription at_point(int point, Vec3 xyz) = 0;
};

}  // namespace carreau
