// SPDX-License-Identifier: BSD-3-Clause
// Prescribed sizes and metrics that a host gives by plain function pointers, as the C ABI registers them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "metric/prescription.h"
#include "support/error.h"

namespace carreau {

/// Kind of answer of a callback of HostMetricTable: the meaning of `value`.
enum class HostMetricKind : std::int32_t {
  none = 0,     ///< no answer
  size = 1,     ///< value[0] = h
  space = 2,    ///< xx, xy, xz, yy, yz, zz of a metric of space
  tangent = 3,  ///< h1, h2, and x, y, z of the direction of h1; h2 holds across it
};
/// Entries of `value`.
inline constexpr std::size_t host_metric_values = 6;

/// Callbacks of a host: values by value, `user` last; nullptr: does not answer. They return 0, no_answer_status, or
/// another status that becomes a CallbackError. `kind` and `value` hold none and NaN before the call.
struct HostMetricTable {
  void* user = nullptr;
  std::int32_t (*surface_metric)(std::int32_t face, double u, double v, std::int32_t* kind, double* value,
                                 void* user) = nullptr;
  /// Evaluates n points: uv is n x 2, xyz n x 3, kind n, value n x host_metric_values, row by row. Used in place of
  /// `surface_metric` when given.
  std::int32_t (*surface_metric_batch)(std::int32_t face, std::int64_t n, const double* uv, const double* xyz,
                                       std::int32_t* kind, double* value, void* user) = nullptr;
  std::int32_t (*curve_metric)(std::int32_t face, std::int32_t ic, double t, std::int32_t* kind, double* value,
                               void* user) = nullptr;
  std::int32_t (*point_metric)(std::int32_t point, std::int32_t* kind, double* value, void* user) = nullptr;
};

/// A tangent answer becomes the metric of space with size h1 along the direction and h2 across it (HDR eq. 4.45).
/// Throws CallbackError for a status, a kind that does not exist, sizes that are not positive and a direction of length
/// zero.
class HostMetrics : public PrescriptionSource {
 public:
  explicit HostMetrics(const HostMetricTable& table) : table_(table) {}

  [[nodiscard]] std::string name() const override { return "the metric callback"; }
  [[nodiscard]] bool needs_position() const noexcept override { return table_.surface_metric_batch != nullptr; }
  Prescription on_surface(int face, Vec2 uv, Vec3 xyz) override;
  void on_surface_points(int face, std::span<const Vec2> uv, std::span<const Vec3> xyz,
                         std::span<Prescription> out) override;
  Prescription on_curve(int face, int ic, double t, Vec2 uv, Vec3 xyz) override;
  Prescription at_point(int point, Vec3 xyz) override;

 private:
  void ask_batch(int face, std::span<const Vec2> uv, std::span<const Vec3> xyz, std::span<Prescription> out) const;

  HostMetricTable table_;
};

}  // namespace carreau
