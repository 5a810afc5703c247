// SPDX-License-Identifier: BSD-3-Clause
// The surface near triangles whose corners are of several charts.
#pragma once

#include <array>

#include "surface/remesh/bounds/triangle_bound.h"
#include "surface/remesh/bounds/spread_triangle.h"

namespace carreau {

/// The places of a triangle with corners in several charts. Each place has the point that lies over it along its normal, at most as far as
/// the surface is from it. Keeps references.
class SpreadPlaces {
 public:
  SpreadPlaces(const SpreadTriangle& triangle, const BoundedTriangle& flat);

  [[nodiscard]] std::array<BoundPlace, TriangleBound::lattice_size> lattice() const;
  [[nodiscard]] BoundPlace at(const PlaceInTriangle& place) const { return over(look(place)); }
  /// Returns whether a normal was found at each place.
  [[nodiscard]] bool has_normals() const noexcept { return has_normals_; }

 private:
  struct Look {
    Vec3 flat, offset, normal;  // the surface from there; its normal, zero: none
    bool found = false;         // near that place
    double away = 0;            // where the normal is from
    double length = 1;          // given to the normal: as long as the way to a pole
  };
  [[nodiscard]] Look look(const PlaceInTriangle& place) const;
  [[nodiscard]] BoundPlace over(const Look& look) const;
  void lean_on_others(Look& look) const;
  [[nodiscard]] double curvature_of(const std::array<Look, TriangleBound::lattice_size>& looks) const;

  const BoundedTriangle& flat_;
  SpreadTriangle triangle_;
  std::array<Look, TriangleBound::lattice_size> looks_;
  bool known_ = false;  // the looks
  mutable bool has_normals_ = true;
  double curvature_ = 0;  // at most, of the surface near
};

}  // namespace carreau
