// SPDX-License-Identifier: BSD-3-Clause
// The face of rows, columns of vertices over its curves, and chains of columns.
#pragma once

#include <vector>

#include "surface/layers/layer_rows.h"

namespace carreau {

/// A face during the making of its rows. Vertices count as in LayerRows.
struct RowFace {
  RowFace(const PatchInput& patch, const LayerCurves& curves, Cad& host, bool is_halved)
      : input(patch),
        layers(curves),
        domain(*patch.domain),
        plane(domain.plane),
        cad(host),
        on_curves(patch.curve_xyz.size()),
        halved(is_halved) {}

  const PatchInput& input;
  const LayerCurves& layers;
  const FaceDomain& domain;
  const PlaneDomain& plane;
  Cad& cad;
  std::size_t on_curves;  ///< vertices of the domain that lie on curves
  bool halved;            ///< of make_layer_rows()
  LayerRows rows;

  [[nodiscard]] bool is_on_curve(int v) const { return static_cast<std::size_t>(v) < on_curves; }
  /// Index of the layers of an edge, which grow on both sides of an internal edge; -1: none.
  [[nodiscard]] int layers_of(const PlaneEdge& edge) const {
    return edge.kind != PlaneEdgeKind::degenerate && is_on_curve(edge.a) && is_on_curve(edge.b) ? layers.of_curve(edge.curve)
                                                                                                 : -1;
  }
  [[nodiscard]] const Vec3& xyz(int v) const {
    const auto k = static_cast<std::size_t>(v);
    return k < on_curves ? input.curve_xyz[k] : rows.xyz[k - plane.vertices.size()];
  }
  [[nodiscard]] const Vec2& uv(int v) const {
    const auto k = static_cast<std::size_t>(v);
    return k < plane.vertices.size() ? plane.vertices[k] : rows.uv[k - plane.vertices.size()];
  }
  [[nodiscard]] Vec3 direction(int a, int b) const { return unit(xyz(b) - xyz(a)); }
  /// The normal of the surface; zero where the parametrisation is degenerate.
  [[nodiscard]] Vec3 normal_at(int v) const {
    const SurfaceJet jet = surface_at(cad, input.ref, want_position | want_first, uv(v));
    return unit(cross(jet.su, jet.sv));
  }
  /// Zero for the zero vector.
  static Vec3 unit(const Vec3& v) {
    const double length = norm(v);
    return length > 0 ? Vec3((1 / length) * v) : Vec3(0, 0, 0);
  }
};

/// A column of vertices that rises from a vertex of a curve.
struct Column {
  int base = -1;    ///< vertex of the domain
  int layers = -1;  ///< index of the layers
  bool on_side = false;  ///< its vertices lie on a curve that ends at the base
  bool stands = true;    ///< false: the corner has no column
  bool is_turned = false;  ///< it belongs to a fan or to a corner
  Vec3 normal{0, 0, 0};  ///< of the surface
  Vec3 up{0, 0, 0};      ///< unit tangent vector across the curve
  Vec3 along{0, 0, 0};   ///< unit tangent vector along the curve
  double stretch = 1;    ///< length along `up` for each height
  double lean = 0;       ///< of the column along the curve, for each height
  std::vector<double> heights;
  std::vector<int> at;  ///< vertices of the whole, the base first
  int levels = 0;       ///< rows that reach this column
};

/// Columns along a run of edges of curves with layers, in the direction of the boundary.
struct RowChain {
  std::vector<Column> columns;
  bool closed = false;
  [[nodiscard]] std::size_t gaps() const { return closed ? columns.size() : columns.size() - 1; }
  [[nodiscard]] std::size_t after(std::size_t c) const { return c + 1 == columns.size() ? 0 : c + 1; }
};

/// Finds the chains of a face, without vertices over their bases. Columns at corners turn, lean or do not stand.
std::vector<RowChain> find_chains(const RowFace& face);

}  // namespace carreau
