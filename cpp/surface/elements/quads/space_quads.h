// SPDX-License-Identifier: BSD-3-Clause
// Quadrilaterals and triangles of several faces, in space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "metric/chart.h"
#include "surface/elements/quads/quad_patch.h"
#include "surface/elements/quads/quad_shape.h"
#include "surface/elements/base/atlas_surface.h"

namespace carreau {

/// Cells whose vertices lie on a surface, whatever its faces; the other surface of the passes of this room is PlaneQuads.
/// A vertex on a border or a sharp line is there once for each smooth side, so that each has one normal. Shapes are measured in the tangent
/// plane of the cell, in the prescribed metric at its corners. Keeps a reference to the surface.
class SpaceQuads {
 public:
  using Place = SurfacePlace;
  using Way = Vec3;
  static constexpr bool on_surface = false;  ///< of trials: settle() brings them there

  /// A plane with a metric.
  struct Frame {
    Vec3 origin, e1, e2;
    Chart chart;
  };

  explicit SpaceQuads(const AtlasSurface& surface) : surface_(surface) {}

  /// Returns its number. A fixed vertex stays, and stays in place.
  std::int32_t add_vertex(const SurfacePlace& place, const WantedSize& wanted, bool fixed);
  std::int32_t add_vertex(const SurfacePlace& place, bool fixed) { return add_vertex(place, surface_.wanted(place), fixed); }
  void fix(std::size_t v, bool fixed) { fixed_[v] = static_cast<char>(fixed); }
  void set_flat(std::vector<std::array<std::int32_t, 3>> flat) { flat_ = std::move(flat); }
  /// Multiplies all sizes by a factor.
  void scale_sizes(double factor);
  [[nodiscard]] const WantedSize& wanted(std::int32_t v) const { return wanted_[v]; }
  [[nodiscard]] const AtlasSurface& surface() const noexcept { return surface_; }

  [[nodiscard]] std::size_t vertices() const noexcept { return place_.size(); }
  [[nodiscard]] std::vector<MixedCell>& cells() noexcept { return cells_; }
  [[nodiscard]] const std::vector<MixedCell>& cells() const noexcept { return cells_; }
  [[nodiscard]] bool is_fixed(std::size_t v) const noexcept { return fixed_[v] != 0; }
  /// Flat corners as in QuadPatch.
  [[nodiscard]] const std::vector<std::array<std::int32_t, 3>>& flat() const noexcept { return flat_; }

  /// Convexity about the cell's own normal, which is on the side of the surface's normals.
  [[nodiscard]] bool is_convex(const MixedCell& cell) const noexcept;
  static constexpr bool has_metric() noexcept { return true; }
  [[nodiscard]] bool has_flat_corner(const MixedCell& cell) const noexcept;
  [[nodiscard]] double quality(const MixedCell& cell) const noexcept { return quality(about(cell), cell); }
  /// The quality, or the least sine of an angle below 0 for cells that are turned over somewhere.
  [[nodiscard]] double untangling_quality(const Frame& frame, const MixedCell& cell) const noexcept;
  /// Length in the prescribed metric at the ends of the edge.
  [[nodiscard]] double length(std::int32_t a, std::int32_t b) const noexcept;

  [[nodiscard]] Frame about(const MixedCell& cell) const noexcept;
  [[nodiscard]] Frame about(std::int32_t v) const noexcept;
  /// The tangent plane there, with lengths as they are.
  static Frame plane_at(const SurfacePlace& place) noexcept;
  [[nodiscard]] Vec2 at(const Frame& frame, std::int32_t v) const noexcept;
  static Way no_way() noexcept { return {0, 0, 0}; }
  static Way way(const Frame& frame, const Vec2& y) noexcept {
    const Vec2 offset = frame.chart.offset(y);
    return offset.x() * frame.e1 + offset.y() * frame.e2;
  }

  /// Frames as in PlaneQuads.
  class KeptFrames {
   public:
    explicit KeptFrames(const SpaceQuads& quads) : quads_(quads) {}
    void reserve(std::size_t cells) { frames_.reserve(cells); }
    void add(const MixedCell& cell) { frames_.push_back(quads_.about(cell)); }
    [[nodiscard]] Vec2 at(std::size_t c, const MixedCell& cell, int k) const noexcept {
      return quads_.at(frames_[c], cell[k]);
    }
    [[nodiscard]] Way way(std::size_t c, const Vec2& y) const noexcept { return SpaceQuads::way(frames_[c], y); }
    [[nodiscard]] Diagonals<Way> diagonals(std::size_t c, const MixedCell& cell) const noexcept {
      const Vec2 y0 = at(c, cell, 0), y1 = at(c, cell, 1), y2 = at(c, cell, 2), y3 = at(c, cell, 3);
      return {y0 - y2, y1 - y3, way(c, 0.25 * (y0 + y2 - y1 - y3))};
    }

   private:
    const SpaceQuads& quads_;
    std::vector<Frame> frames_;
  };

  [[nodiscard]] const Place& place(std::size_t v) const noexcept { return place_[v]; }
  [[nodiscard]] const std::vector<Place>& places() const noexcept { return place_; }
  [[nodiscard]] bool is_at(std::size_t v, const Place& place) const noexcept { return place_[v].xyz == place.xyz; }
  void put(std::size_t v, const Place& place);
  /// Puts the vertex beside the surface, for a trial: no evaluation.
  void try_at(std::size_t v, const Place& from, const Way& way) noexcept { place_[v].xyz = from.xyz + way; }
  /// Puts the vertex on the surface, from its place before the trial; false: no way leads there.
  bool settle(std::size_t v, const Place& from);
  /// The vertex stays if no way leads there.
  void move(std::size_t v, const Way& way);
  void approach(std::size_t v, std::size_t other) { move(v, 0.5 * (place_[other].xyz - place_[v].xyz)); }

 private:
  [[nodiscard]] double quality(const Frame& frame, const MixedCell& cell) const noexcept;
  [[nodiscard]] Frame frame(const Vec3& origin, const Vec3& normal, const WantedSize* const* wanted, int n) const noexcept;
  [[nodiscard]] Vec3 area_normal(const MixedCell& cell) const noexcept;
  [[nodiscard]] Vec3 surface_normal(const MixedCell& cell) const noexcept;

  const AtlasSurface& surface_;
  std::vector<SurfacePlace> place_;
  std::vector<WantedSize> wanted_;
  std::vector<char> fixed_;
  std::vector<MixedCell> cells_;
  std::vector<std::array<std::int32_t, 3>> flat_;
};

}  // namespace carreau
