// SPDX-License-Identifier: BSD-3-Clause
// Shapes of quadrilaterals (HDR sec. 1.1.1).
#pragma once

#include <array>
#include <span>

#include "predicates/convex_quad.h"
#include "surface/elements/quads/quad_patch.h"

namespace carreau {

/// (2 + 2 sqrt 2) / sigma, sigma = h / rho (HDR sec. 1.1.1). Here h is the diameter, and rho the least inradius of the
/// four triangles of two edges that meet. 1 for a square; 0 unless it is strictly convex and counterclockwise.
double quad_quality(const std::array<Vec2, 4>& p) noexcept;
/// The quality in space, if the quadrilateral is counterclockwise about the normal of its diagonals.
double quad_quality(const std::array<Vec3, 4>& p) noexcept;
/// Least sine of the angles at the corners; below 0 if a corner is turned over.
double scaled_jacobian(const std::array<Vec2, 4>& p) noexcept;
double scaled_jacobian(const std::array<Vec3, 4>& p) noexcept;
/// Returns whether the scaled Jacobian is not above 0.
bool is_turned_over(const std::array<Vec3, 4>& p) noexcept;
/// The less of scaled Jacobian and quality, in space.
double min_shape(const std::array<Vec3, 4>& p) noexcept;

/// Strictly convex and counterclockwise in (u, v), exactly; of triangles: counterclockwise.
inline bool is_convex(const QuadPatch& patch, const MixedCell& cell) noexcept {
  const Vec2 &a = patch.uv[cell[0]], &b = patch.uv[cell[1]], &c = patch.uv[cell[2]];
  return corners_of(cell) == 3 ? orientation(a, b, c) > 0 : is_convex_quad(a, b, c, patch.uv[cell[3]]);
}
/// Returns whether two sides of the cell, between fixed vertices, are edges of curves that go on smoothly into each
/// other: `flat` as in QuadPatch.
bool has_flat_corner(std::span<const char> fixed, std::span<const std::array<std::int32_t, 3>> flat,
                     const MixedCell& cell) noexcept;
inline bool has_flat_corner(const QuadPatch& patch, const MixedCell& cell) noexcept {
  return has_flat_corner(patch.fixed, patch.flat, cell);
}
/// Quality in the metric: of a triangle Q2 (HDR eq. 1.6).
double cell_quality(const QuadPatch& patch, const FaceCharts& charts, const MixedCell& cell) noexcept;
/// Quality in a given chart.
double cell_quality(const QuadPatch& patch, const Chart& chart, const MixedCell& cell) noexcept;

/// The quality, or the scaled Jacobian below 0 for cells that are turned over somewhere, so that a search can follow
/// it.
double untangling_quality(const QuadPatch& patch, const Chart& chart, const MixedCell& cell) noexcept;

/// The diagonals of a quadrilateral, in a frame.
template <typename Way>
struct Diagonals {
  Vec2 first, second;  ///< corner 0 less 2, 1 less 3
  Way between;         ///< half the way from the middle of the second diagonal to the middle of the first
};

/// The cells of one face as the passes of this room see them, whose other surface is SpaceQuads. Keeps references.
class PlaneQuads {
 public:
  using Place = Vec2;
  using Way = Vec2;
  using Frame = Chart;
  static constexpr bool on_surface = true;  ///< wherever vertices go

  PlaneQuads(QuadPatch& patch, const FaceCharts& charts) : patch_(patch), charts_(&charts) {}
  /// Without a metric, for pair_triangles() and turn_ears().
  explicit PlaneQuads(QuadPatch& patch) : patch_(patch) {}
  [[nodiscard]] bool has_metric() const noexcept { return charts_ != nullptr; }

  [[nodiscard]] std::size_t vertices() const noexcept { return patch_.uv.size(); }
  [[nodiscard]] std::vector<MixedCell>& cells() noexcept { return patch_.cells; }
  [[nodiscard]] const std::vector<MixedCell>& cells() const noexcept { return patch_.cells; }
  [[nodiscard]] bool is_fixed(std::size_t v) const noexcept { return patch_.fixed[v] != 0; }
  [[nodiscard]] const std::vector<std::array<std::int32_t, 3>>& flat() const noexcept { return patch_.flat; }

  [[nodiscard]] bool is_convex(const MixedCell& cell) const noexcept { return carreau::is_convex(patch_, cell); }
  [[nodiscard]] bool has_flat_corner(const MixedCell& cell) const noexcept {
    return carreau::has_flat_corner(patch_.fixed, patch_.flat, cell);
  }
  [[nodiscard]] double quality(const MixedCell& cell) const noexcept { return cell_quality(patch_, *charts_, cell); }
  [[nodiscard]] double untangling_quality(const Frame& frame, const MixedCell& cell) const noexcept {
    return carreau::untangling_quality(patch_, frame, cell);
  }
  [[nodiscard]] double length(std::int32_t a, std::int32_t b) const noexcept {
    return length_in(*charts_, patch_.uv[a], patch_.uv[b]);
  }

  [[nodiscard]] Frame about(const MixedCell& cell) const noexcept { return charts_->about(patch_, cell); }
  [[nodiscard]] Frame about(std::int32_t v) const noexcept { return charts_->about(patch_.uv[v]); }
  [[nodiscard]] Vec2 at(const Frame& frame, std::int32_t v) const noexcept { return frame.at(patch_.uv[v]); }
  static Way no_way() noexcept { return {0, 0}; }
  static Way way(const Frame& frame, const Vec2& y) noexcept { return frame.offset(y); }

  /// Frames of some cells that stay while vertices move. Frames of a metric that does not bend are linear.
  class KeptFrames {
   public:
    explicit KeptFrames(const PlaneQuads& quads) : quads_(quads) {}
    void reserve(std::size_t cells) {
      linear_.reserve(cells);
      if (quads_.charts_->bends()) charts_.reserve(cells);
    }
    void add(const MixedCell& cell) {
      const Chart chart = quads_.about(cell);
      linear_.emplace_back(chart);
      if (quads_.charts_->bends()) charts_.push_back(chart);
    }
    /// Corner k of added cell number c.
    [[nodiscard]] Vec2 at(std::size_t c, const MixedCell& cell, int k) const noexcept {
      const std::vector<Vec2>& uv = quads_.patch_.uv;
      return charts_.empty() ? linear_[c].at(uv[cell[k]] - uv[cell[0]]) : charts_[c].at(uv[cell[k]]);
    }
    [[nodiscard]] Way way(std::size_t c, const Vec2& y) const noexcept { return linear_[c].offset(y); }
    [[nodiscard]] Diagonals<Way> diagonals(std::size_t c, const MixedCell& cell) const noexcept {
      const std::vector<Vec2>& uv = quads_.patch_.uv;
      const Vec2 &p = uv[cell[0]], &q = uv[cell[1]], &r = uv[cell[2]], &s = uv[cell[3]];
      const Linear& linear = linear_[c];
      if (charts_.empty()) return {linear.at(p - r), linear.at(q - s), 0.25 * (p + r - q - s)};
      const Vec2 y0 = charts_[c].at(p), y1 = charts_[c].at(q), y2 = charts_[c].at(r), y3 = charts_[c].at(s);
      return {y0 - y2, y1 - y3, linear.offset(0.25 * (y0 + y2 - y1 - y3))};
    }

   private:
    /// The linear part of a chart near its origin, and its inverse.
    struct Linear {
      double p, q, r, ip, iq, ir;

      explicit Linear(const Chart& chart) noexcept {
        const Vec2 x = chart.offset({1, 0}), y = chart.offset({0, 1});
        ip = x.x(), iq = y.x(), ir = y.y();
        p = 1 / ip, r = 1 / ir, q = -iq * p * r;
      }
      [[nodiscard]] Vec2 at(const Vec2& e) const noexcept { return {p * e.x() + q * e.y(), r * e.y()}; }
      [[nodiscard]] Vec2 offset(const Vec2& d) const noexcept { return {ip * d.x() + iq * d.y(), ir * d.y()}; }
    };

    const PlaneQuads& quads_;
    std::vector<Linear> linear_;
    std::vector<Chart> charts_;  // where the metric bends
  };

  [[nodiscard]] const Place& place(std::size_t v) const noexcept { return patch_.uv[v]; }
  [[nodiscard]] const std::vector<Place>& places() const noexcept { return patch_.uv; }
  [[nodiscard]] bool is_at(std::size_t v, const Place& place) const noexcept { return patch_.uv[v] == place; }
  void put(std::size_t v, const Place& place) noexcept { patch_.uv[v] = place; }
  /// Puts the vertex beside a place, for a trial.
  void try_at(std::size_t v, const Place& from, const Way& way) noexcept { patch_.uv[v] = from + way; }
  /// Keeps the place of a trial; false: the place is not possible.
  static bool settle(std::size_t /*v*/, const Place& /*from*/) noexcept { return true; }
  void move(std::size_t v, const Way& way) noexcept { patch_.uv[v] += way; }
  /// Moves halfway to another vertex.
  void approach(std::size_t v, std::size_t other) noexcept { patch_.uv[v] = 0.5 * (patch_.uv[v] + patch_.uv[other]); }

 private:
  QuadPatch& patch_;
  const FaceCharts* charts_ = nullptr;
};

}  // namespace carreau
