// SPDX-License-Identifier: BSD-3-Clause
// Bounds of the distance between a triangle and the surface over it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "support/infinity.h"
#include "support/vec.h"

namespace carreau {

/// The surface at a place of a triangle: a point, and a normal of any length (Su x Sv), zero where it has none.
struct BoundPlace {
  Vec3 s, n;
  double lean = 0;  ///< radians that the normal may be off by
};

/// A triangle of a mesh, and the surroundings of its sides. Side i goes from corner i to the next one.
struct BoundedTriangle {
  BoundedTriangle() = default;
  explicit BoundedTriangle(const std::array<Vec3, 3>& corners) noexcept;
  [[nodiscard]] bool is_flat() const noexcept { return !(norm(normal) > 0); }

  std::array<Vec3, 3> p;
  Vec3 normal;                  ///< of unit length; zero: no area
  std::array<Vec3, 3> outward;  ///< of sides, in the plane, of unit length
  double longest = 0;
  std::array<bool, 3> open_side{true, true, true}, open_corner{true, true, true};  ///< the mesh ends there
  /// The triangles around: tangent of the largest angle with one of them, and their smallest height.
  double slope = infinity, reach = 0;
  double deviation_floor = 0, angle_floor = 0;  ///< bounds need not be nearer to the observed values; model length, radians
  double deviation_tolerance = infinity, angle_tolerance = infinity;  ///< bounds beyond are nearer to it
  bool decides = false;  ///< only whether bounds are beyond matters
  bool roughly = false;  ///< for triangles of edits to test: bounds may be looser, for few places
};

/// Weights of the second and the third corner.
using PlaceInTriangle = Vec2;

/// Bounds of HDR eq. 4.1 and 4.3 for one triangle: A0, no point of the surface over it is farther from the mesh; and A1, no normal there
/// makes a larger angle with its own. They hold under a condition on second derivatives of the surface, and of Su x Sv, along the sides of
/// each part of the triangle. These must differ from a constant by at most the largest observed second difference (thresholds.h).
///
/// Over a part of the triangle these second derivatives bound the distance of the surface from the linear interpolation of its corners. The
/// distance of the interpolation from a convex set is largest at a corner. Parts for which that leaves too much open are cut into four.
class TriangleBound {
 public:
  static constexpr std::size_t lattice_size = 15;
  /// The places of the first evaluations: quarters of the sides and three inside.
  static const std::array<PlaceInTriangle, lattice_size>& lattice() noexcept;

  TriangleBound(const BoundedTriangle& triangle, std::span<const BoundPlace, lattice_size> places);

  /// Places to evaluate next; empty: done.
  [[nodiscard]] const std::vector<PlaceInTriangle>& wanted() const noexcept { return wanted_; }
  void take(std::span<const BoundPlace> places);

  [[nodiscard]] double deviation() const noexcept { return deviation_; }
  [[nodiscard]] double angle() const noexcept { return angle_; }  ///< radians; pi where the surface is turned over, or no normal is known

 private:
  /// Second differences along a side: of the height over the plane, of the whole vector, and of the two parts of the normal. One part is
  /// along the triangle's normal, the other across it. The last ones are differences across the sides.
  struct Bend {
    double height = 0, whole = 0, upright = 0, leaning = 0;
    std::array<double, 3> across{};
    void raise(const Bend& other) noexcept;
    [[nodiscard]] Bend times(double factor) const noexcept;
  };
  using Bends = std::array<Bend, 3>;
  struct Seen {
    BoundPlace place;
    PlaceInTriangle at;
    double height = 0, angle = 0, upright = 0;  ///< over the plane; of the normal; its part along the triangle's normal
    std::array<double, 3> beyond{};             ///< sides
    bool singular = false;
  };
  struct Part {
    std::array<Seen, 3> corner;
    Bends bends;
    int cuts = 0;
  };

  [[nodiscard]] Seen see(const BoundPlace& place, const PlaceInTriangle& at);
  [[nodiscard]] Bend bend_of(const BoundPlace& p, const BoundPlace& middle, const BoundPlace& q) const noexcept;
  void cut(const std::array<Seen, 3>& corner, const std::array<Seen, 3>& middle, const Bends& bends, int cuts);
  void cut_at_pole(const Part& part, const std::array<Seen, 3>& middle, Bends bends);
  void judge(Part&& part);
  [[nodiscard]] double deviation_of(const Part& part) const noexcept;
  [[nodiscard]] double overshoot_of(const Part& part) const noexcept;
  [[nodiscard]] bool goes_on_beside(const Part& part, double overshoot) const noexcept;
  [[nodiscard]] double angle_of(const Part& part) const noexcept;
  void want_middles();

  BoundedTriangle triangle_;
  double singular_ = 0;  // shorter normals do not count
  double seen_deviation_ = 0, seen_angle_ = 0;
  double deviation_ = 0, angle_ = 0;
  int parts_ = 0;
  std::vector<Part> open_;
  std::vector<PlaceInTriangle> wanted_;  // once each
  std::vector<std::size_t> middle_;       // of each side of each open part: its rank in wanted_
};

}  // namespace carreau
