// SPDX-License-Identifier: BSD-3-Clause
// Sizes and metrics prescribed at the points of a plane domain, and along its curves (RR-2818 sec. 4.1, 4.3.3).
#pragma once

#include <map>
#include <memory>

#include "geometry/plane/plane_cad.h"
#include "metric/prescription.h"

namespace carreau {

/// Values at points hold at these points. Along a curve they vary with its length between its points with values, and
/// are constant beyond the first and the last one. Inside faces there is no answer.
class PointSizes final : public PrescriptionSource {
 public:
  /// `points`: indices of points by their references in the model.
  PointSizes(const PlaneDomainInput& input, std::shared_ptr<const PlaneCad> cad, std::map<int, int> points);

  [[nodiscard]] std::string name() const override { return "the sizes at the points of the plane domain"; }
  [[nodiscard]] bool needs_position() const noexcept override { return false; }
  void begin_run(MetricLaw law) override { law_ = law; }
  /// Parameters at which values are known.
  [[nodiscard]] std::vector<double> kinks_on_curve(int face, int ic) const override;
  Prescription on_surface(int face, Vec2 uv, Vec3 xyz) override;
  Prescription on_curve(int face, int ic, double t, Vec2 uv, Vec3 xyz) override;
  Prescription at_point(int point, Vec3 xyz) override;

 private:
  struct Value {
    Metric2 metric;
    bool is_size = true;
  };
  /// Known values on an arc: lengths from its start to its points that have a value.
  struct Known {
    std::vector<double> length;
    std::vector<double> parameter;
    std::vector<Value> value;
  };
  [[nodiscard]] double length_at(int arc, double t) const;
  static Prescription answer(const Value& value);

  std::shared_ptr<const PlaneCad> cad_;
  std::map<int, int> points_;
  std::vector<std::optional<Value>> value_;   // of each point
  std::vector<std::vector<double>> lengths_;  // of each arc
  std::vector<Known> known_;                  // of each arc
  MetricLaw law_ = MetricLaw::linear;
};

}  // namespace carreau
