// SPDX-License-Identifier: BSD-3-Clause
// The surface near triangles whose corners are of several charts.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cad/cad.h"
#include "surface/remesh/base/charts.h"

namespace carreau {

/// A triangle with corners in several charts. Keeps references to the charts and `cad`.
class SpreadTriangle {
 public:
  /// `turned`: normals of its face have the other side than the atlas.
  SpreadTriangle(const Charts& charts, Cad& cad, const std::array<Vec3, 3>& corners, const std::array<SurfacePlace, 3>& places, bool turned)
      : charts_(charts), cad_(cad), corner_(corners), place_(places), turned_(turned) {}

  /// Sets the pole: the only corner without a normal, a pole or an apex. `ends`: its places in the faces there.
  void set_pole(std::vector<SurfacePlace> ends);
  [[nodiscard]] int pole() const noexcept { return pole_; }  ///< -1: none

  /// The place itself, with these weights of the corners.
  [[nodiscard]] Vec3 flat(const std::array<double, 3>& weight) const;
  /// The surface near that place. The search starts at the corner of the largest weight that leads there, and ends at the place or at a
  /// barrier beside. Below a pole it follows the way to the pole from the place over the side across, as ways run in (u, v).
  [[nodiscard]] std::optional<SurfacePlace> over(const std::array<double, 3>& weight) const;
  /// The surface at a corner.
  [[nodiscard]] const SurfacePlace& corner(std::size_t i) const { return place_[i]; }
  /// The unit normal there, on the side of the triangle's face.
  [[nodiscard]] Vec3 normal(const SurfacePlace& place) const;

 private:
  [[nodiscard]] std::optional<SurfacePlace> near(const std::array<double, 3>& weight) const;
  [[nodiscard]] std::optional<SurfacePlace> below_pole(const std::array<double, 3>& weight) const;

  const Charts& charts_;
  Cad& cad_;
  std::array<Vec3, 3> corner_;
  std::array<SurfacePlace, 3> place_;
  bool turned_;
  int pole_ = -1;
  std::vector<SurfacePlace> ends_;  // of the pole
};

}  // namespace carreau
