// SPDX-License-Identifier: BSD-3-Clause
// Vertices with their places on a surface of several faces, and their sizes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "metric/metric3.h"
#include "surface/surface_place.h"

namespace carreau {

class PlacedVertices {
 public:
  explicit PlacedVertices(bool by_direction) : by_direction_(by_direction) {}

  [[nodiscard]] std::size_t vertices() const noexcept { return place_.size(); }
  /// Neither on a sharp edge nor a corner.
  [[nodiscard]] bool is_free(std::int32_t v) const { return several_[v] < 0; }
  [[nodiscard]] const SurfacePlace& place(std::int32_t v) const { return place_[v]; }
  [[nodiscard]] Vec3 position(std::int32_t v) const { return place_[v].xyz; }
  /// Several places of a vertex that is kept, one for each vertex of a face that it was.
  [[nodiscard]] std::span<const SurfacePlace> places(std::int32_t v) const {
    return is_free(v) ? std::span<const SurfacePlace>(&place_[v], 1) : kept_places_[several_[v]];
  }
  /// The place with the normal nearest to `normal`.
  [[nodiscard]] const SurfacePlace& place_towards(std::int32_t v, const Vec3& normal) const {
    return is_free(v) ? place_[v] : kept_place_towards(v, normal);
  }
  /// True if sizes differ by direction.
  [[nodiscard]] bool by_direction() const noexcept { return by_direction_; }
  [[nodiscard]] double size(std::int32_t v) const { return size_[v]; }
  [[nodiscard]] WantedSize wanted(std::int32_t v) const { return {size_[v], by_direction_ ? metric_[v] : Metric3{}}; }
  /// At v, along the way to w.
  [[nodiscard]] double size_along(std::int32_t v, std::int32_t w) const;

  /// Adds a free vertex.
  std::int32_t add(const SurfacePlace& place, const WantedSize& wanted);
  std::int32_t add_kept(std::vector<SurfacePlace> places, const WantedSize& wanted);
  void move(std::int32_t v, const SurfacePlace& place, const WantedSize& wanted);
  void scale_sizes(double factor);

 protected:
  void remove_last();
  [[nodiscard]] const SurfacePlace& kept_place_towards(std::int32_t v, const Vec3& normal) const;

  bool by_direction_;
  std::vector<SurfacePlace> place_;
  std::vector<double> size_;
  std::vector<Metric3> metric_;        // by vertex; empty: sizes do not differ by direction
  std::vector<std::int32_t> several_;  // by vertex: index in kept_places_, -1: free
  std::vector<std::vector<SurfacePlace>> kept_places_;
};

}  // namespace carreau
