// SPDX-License-Identifier: BSD-3-Clause
// Places of a surface of several faces, and the way from one to another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "metric/metric3.h"
#include "support/vec.h"

namespace carreau {

/// A place of the surface: (u, v) in the face of a triangle of the atlas which holds it.
struct Foot {
  std::int32_t triangle = -1;
  Vec2 uv;
};

/// The surface at a place of the atlas.
struct SurfacePlace {
  Foot foot;
  Vec3 xyz, su, sv;
  Vec3 normal;           ///< unit, on the side that the atlas has turned to; zero where singular
  bool regular = false;  ///< there is a normal
};

/// The prescribed size at a vertex.
struct WantedSize {
  double h = 0;    ///< sqrt(h1 h2) where sizes differ by direction
  Metric3 metric;  ///< used where they do; at a vertex that is not kept it has no entry along the normal
};

/// Returns the size times the factor.
inline WantedSize scaled(const WantedSize& wanted, double factor) noexcept {
  WantedSize result = wanted;
  result.h *= factor;
  const double k = 1 / (factor * factor);
  Metric3& m = result.metric;
  for (double* entry : {&m.xx, &m.xy, &m.xz, &m.yy, &m.yz, &m.zz}) *entry *= k;
  return result;
}

/// The surface around a place, whatever its faces, for algorithms that move vertices on it.
class SurfaceAround {
 public:
  virtual ~SurfaceAround() = default;
  /// Returns a place near `target`, sought from a regular place; empty if a barrier or a singular place is in the way.
  [[nodiscard]] virtual std::optional<SurfacePlace> towards(const SurfacePlace& from, const Vec3& target) const = 0;
  [[nodiscard]] virtual WantedSize wanted(const SurfacePlace& place) const = 0;
  [[nodiscard]] virtual bool by_direction() const noexcept = 0;
};

/// Vertices with their places, for algorithms that distribute cells among faces.
class PlacedVertices {
 public:
  virtual ~PlacedVertices() = default;
  [[nodiscard]] virtual std::size_t vertices() const = 0;
  /// Returns whether the vertex is neither on a sharp edge nor a corner.
  [[nodiscard]] virtual bool is_free(std::int32_t v) const = 0;
  /// The places of a vertex: several if it is kept, one for each vertex of a face that it was.
  [[nodiscard]] virtual std::span<const SurfacePlace> places(std::int32_t v) const = 0;
  [[nodiscard]] virtual Vec3 position(std::int32_t v) const = 0;
  [[nodiscard]] virtual double size(std::int32_t v) const = 0;
  /// The size at v along the way to w.
  [[nodiscard]] virtual double size_along(std::int32_t v, std::int32_t w) const = 0;
  /// Returns whether sizes differ by direction.
  [[nodiscard]] virtual bool by_direction() const noexcept = 0;
};

}  // namespace carreau
