// SPDX-License-Identifier: BSD-3-Clause
// A surface that is smooth almost everywhere over triangles (HDR sec. 4.9.2).
#pragma once

#include <memory>
#include <vector>

#include "geometry/discrete/gregory.h"
#include "geometry/discrete/sharp_lines.h"
#include "geometry/discrete/triangulation.h"

namespace carreau::discrete {

/// One Gregory triangle for each triangle. Tangent planes agree over edges that are not sharp, curves over sharp edges,
/// and vertices are interpolated. Safe from several threads.
class DiscreteSurface {
 public:
  /// `faces`: references of faces by triangle; empty: see face_refs().
  DiscreteSurface(Triangulation triangulation, SharpLines found, std::vector<std::int32_t> faces = {});

  [[nodiscard]] const Triangulation& mesh() const noexcept { return mesh_; }
  [[nodiscard]] const SharpLines& lines() const noexcept { return lines_; }
  [[nodiscard]] const std::vector<std::int32_t>& faces() const noexcept { return faces_; }
  [[nodiscard]] std::size_t triangles() const noexcept { return mesh_.triangles.size(); }

  /// (u, v): weights of the second and third corner of the triangle.
  [[nodiscard]] SurfaceJet at(std::int32_t triangle, Vec2 uv, unsigned want) const {
    return patches_[static_cast<std::size_t>(triangle)].at(uv, want);
  }
  [[nodiscard]] const GregoryTriangle& patch(std::int32_t triangle) const {
    return patches_[static_cast<std::size_t>(triangle)];
  }
  /// The curve of an edge, from the smaller vertex on.
  [[nodiscard]] const Cubic& curve(std::int32_t edge) const { return curves_[static_cast<std::size_t>(edge)]; }
  /// The normal of the region at a corner of a triangle, of unit length (eq. 4.96).
  [[nodiscard]] const Vec3& normal(std::int32_t triangle, int k) const {
    return normals_[3 * static_cast<std::size_t>(triangle) + static_cast<std::size_t>(k % 3)];
  }
  /// Tangents around vertices that turned back and were unfolded (eq. 4.101), and tangents that still turn back.
  [[nodiscard]] std::int64_t unfolded() const noexcept { return unfolded_; }
  [[nodiscard]] std::int64_t folded() const noexcept { return folded_; }
  /// No point of the surface is farther from the triangles, and no point of the triangles from the surface; model
  /// length.
  [[nodiscard]] double deviation() const noexcept;

 private:
  Triangulation mesh_;
  SharpLines lines_;
  std::vector<std::int32_t> faces_;
  std::vector<Vec3> normals_;
  std::vector<Cubic> curves_;
  std::vector<GregoryTriangle> patches_;
  std::int64_t unfolded_ = 0, folded_ = 0;
};

}  // namespace carreau::discrete
