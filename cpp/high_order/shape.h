// SPDX-License-Identifier: BSD-3-Clause
// Polynomial elements of any order: nodes of the reference element, Bezier points, Jacobians.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// The places of nodes on the edges of a reference element. Values are part of the C ABI.
enum class NodePlaces : int {
  equidistant = 0,
  gauss_lobatto = 1  ///< zeros of s (1 - s) P'_p(2 s - 1), and their products and quotients inside
};

/// The p + 1 places of an edge in [0, 1], ascending.
std::vector<double> places_on_edge(int order, NodePlaces places);

/// Indices (i, k) of nodes in Gmsh's order (types 21, 23, 36, 37): corners, edges counterclockwise, then the inner nodes as those of a smaller
/// element. A triangle has i + k <= p.
std::vector<std::array<int, 2>> node_indices(bool quad, int order);

/// Coordinates (s, t) of the reference element of the nodes with these indices: the triangle s, t >= 0, s + t <= 1, or the unit square.
std::vector<Vec2> node_coordinates(bool quad, int order, NodePlaces places, std::span<const std::array<int, 2>> indices);

/// A kind of elements. Nodes are in Gmsh's order.
class ElementShape {
 public:
  ElementShape(bool quad, int order, NodePlaces places);

  [[nodiscard]] bool is_quad() const noexcept { return quad_; }
  [[nodiscard]] int order() const noexcept { return order_; }
  [[nodiscard]] std::size_t node_count() const noexcept { return reference_.size(); }
  [[nodiscard]] int corner_count() const noexcept { return quad_ ? 4 : 3; }
  [[nodiscard]] std::size_t first_inner() const noexcept { return static_cast<std::size_t>(corner_count() * order_); }
  [[nodiscard]] const std::vector<Vec2>& reference() const noexcept { return reference_; }

  /// A lower bound of the Jacobian along its mean over the mean, by Bernstein coefficients (degree 2 (p - 1), or (2 p - 1, 2 p - 1)) of the element and, where
  /// these are not positive, of its parts. Positive: the element is valid everywhere.
  [[nodiscard]] double least_jacobian(std::span<const Vec3> nodes) const;

  /// Values of the shape functions at places, one row for each.
  [[nodiscard]] std::vector<double> values_at(std::span<const Vec2> places) const;

  /// Gives inner nodes the places that the nodes of edges imply: each edge's difference from its chord is extended as a polynomial that vanishes on the other
  /// edges (triangles), or by transfinite means (quadrilaterals).
  template <typename V>
  void place_inner(std::span<V> nodes) const {
    for (std::size_t i = first_inner(); i < nodes.size(); ++i) {
      V sum = nodes[i] * 0.0;
      for (std::size_t k = 0; k < first_inner(); ++k) sum += inner_[(i - first_inner()) * first_inner() + k] * nodes[k];
      nodes[i] = sum;
    }
  }

 private:
  void fill_inner(std::span<const double> places);
  void fill_products();

  bool quad_;
  int order_;
  std::vector<Vec2> reference_;
  std::vector<std::array<int, 2>> indices_;
  std::vector<double> to_bezier_;  // rows by Bezier point (indices_), columns by node
  std::vector<double> inner_;      // weights of nodes of edges for inner nodes
  /// Products of differences of Bezier points, in s at (i, k) and in t at (m, l), that are parts of the coefficient at (i + m, k + l).
  struct Product {
    std::array<std::uint8_t, 4> at;
    double weight;
  };
  std::vector<Product> products_;
  std::vector<std::array<int, 2>> coefficients_;  // indices of the Jacobian
};

}  // namespace carreau
