// SPDX-License-Identifier: BSD-3-Clause
// Fields on elements of second order: location of points in an element, and interpolation there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/cells.h"
#include "mesh/surface_mesh.h"

namespace carreau {

/// Elements of second order, each with the triangles that find it. References only.
class CurvedElements {
 public:
  /// No elements.
  CurvedElements() = default;
  /// Elements of a face in its parameter plane, by its triangles. Empty if the face is straight.
  CurvedElements(const SurfaceMesh& mesh, const FaceMesh& face);
  /// Elements of all faces in space, by their triangles, face by face.
  explicit CurvedElements(const SurfaceMesh& mesh);

  [[nodiscard]] bool has(std::int32_t triangle) const noexcept {
    return static_cast<std::size_t>(triangle) < of_triangle_.size();
  }
  /// The field at p by the shape functions of the element of `triangle`. If p lies in an element that shares a corner
  /// with it, that element's shape functions are used. `values`: of vertices, then of mid_vertices, `components`
  /// together; so `out`. For elements in the parameter plane, p is (u, v, 0); if `in_space`, p is a point of space.
  void interpolate(std::int32_t triangle, const Vec3& p, bool in_space, std::span<const double> values,
                   std::size_t components, double* out) const;

 private:
  struct Place {
    std::int32_t cell;
    double s, t, inside;  // of the reference element; least barycentric or Cartesian coordinate
  };
  void add(const SurfaceMesh& mesh, const FaceMesh& face);
  void number_corners();
  [[nodiscard]] Place place_in(std::int32_t cell, const Vec3& p, bool in_space) const;

  std::vector<Cell> cells_;              // by rows of values
  std::vector<std::array<Vec3, 8>> uv_;  // by cell; empty where only space is known
  std::vector<std::array<Vec3, 8>> xyz_;
  std::vector<std::int32_t> of_triangle_;
  std::vector<std::int32_t> first_, at_corner_;  // by row of a corner: its cells
};

}  // namespace carreau
