// SPDX-License-Identifier: BSD-3-Clause
// The surface under elements of several faces.
#pragma once

#include <optional>
#include <span>

#include "support/shares.h"
#include "surface/elements/base/thresholds.h"
#include "surface/remesh/base/charts.h"

namespace carreau {

/// The surface of an atlas. A factor scales its sizes. Keeps references.
class AtlasSurface {
 public:
  AtlasSurface(const Charts& charts, Cad& cad) : charts_(charts), cad_(cad) {}

  /// The surface near `target`, sought from a regular place; empty where a barrier or a singular place is in the way.
  [[nodiscard]] std::optional<SurfacePlace> towards(const SurfacePlace& from, const Vec3& target) const {
    return charts_.towards(cad_, from, target, false, shares::small);
  }
  /// Returns the result of towards(), or the place beside the target on a barrier that is in the way.
  [[nodiscard]] std::optional<SurfacePlace> beside(const SurfacePlace& from, const Vec3& target) const {
    return from.regular ? charts_.towards(cad_, from, target, true, shares::small) : std::nullopt;
  }
  [[nodiscard]] WantedSize wanted(const SurfacePlace& place) const { return wanted_at({&place, 1}); }
  /// The size at a vertex with several places.
  [[nodiscard]] WantedSize wanted_at(std::span<const SurfacePlace> places) const { return scaled(charts_.wanted(places), factor_); }
  [[nodiscard]] bool by_direction() const noexcept { return charts_.by_direction(); }

  void scale_sizes(double factor) noexcept { factor_ *= factor; }
  [[nodiscard]] const Charts& charts() const noexcept { return charts_; }
  [[nodiscard]] Cad& cad() const noexcept { return cad_; }

 private:
  const Charts& charts_;
  Cad& cad_;
  double factor_ = 1;
};

}  // namespace carreau
