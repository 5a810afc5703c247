// SPDX-License-Identifier: BSD-3-Clause
// A C1 surface near a triangulation: height fields over the charts of an atlas, blended by its partition of unity.
#pragma once

#include <memory>

#include "cad/cad.h"
#include "geometry/atlas/height_blend.h"
#include "geometry/atlas/mend_folds.h"
#include "geometry/built_geometry.h"

namespace carreau::atlas {

/// S(m) = H(x) at x = sum of alpha_j P_j(phi_ij m): the primitives P_j place m in space, and H moves the place onto the
/// heights of all vertices, which are blended by weights of space. Transitions are not projections: the P_j of a place
/// lie apart on the surface, and x is below it by the height of their chord. The point does not depend on the chart of
/// m.
class BlendedSurface {
 public:
  explicit BlendedSurface(Covering covering);

  [[nodiscard]] const Covering& covering() const { return covering_; }
  [[nodiscard]] const Primitive& primitive(std::size_t chart) const { return primitives_[chart]; }
  /// Folds that were found and repaired where charts disagree.
  [[nodiscard]] const FoldReport& folds() const { return folds_; }
  /// Point and derivatives to order two, or one for less work. Beyond the chart's region it is the chart's own
  /// primitive.
  [[nodiscard]] SurfaceJet at(std::size_t chart, const Vec2& m, int order = 2) const;

  /// Point and derivatives by the place of a T.
  [[nodiscard]] SurfaceJet at_triple(std::size_t triple, const Vec2& place) const;

  /// The border of a chart's face: the face holds the points of each T that are nearer to its corner than to the
  /// others. Side k runs from the middle of T number k of the chart to the middle of the next, t from -1 to 1, and is
  /// C1.
  [[nodiscard]] CurveJet side(std::size_t chart, std::size_t k, double t) const;

 private:
  template <typename Number>
  [[nodiscard]] std::array<Number, 3> blended(std::size_t chart, const Pair<Number>& place) const;
  /// The point at a place of a T; `own` is the point of the primitive at `corner`.
  template <typename Number>
  [[nodiscard]] std::array<Number, 3> blended(std::size_t triple, const Pair<Number>& place, int corner,
                                              const std::array<Number, 3>& own) const;
  template <typename Number>
  [[nodiscard]] std::array<Number, 3> placed(std::size_t triple, const Pair<Number>& place, int corner) const;
  /// x on the heights about the vertices around.
  template <typename Number>
  [[nodiscard]] std::array<Number, 3> onto(const std::vector<std::int32_t>& vertices,
                                           const std::array<Number, 3>& x) const;

  Covering covering_;
  HeightBlend heights_;
  std::vector<Primitive> primitives_;
  FoldReport folds_;
};

/// Each chart becomes a face, whose reference is its rank from 1, trimmed to the points nearest to it. Double zones
/// become curves, triple ones points.
BuiltGeometry build_atlas(std::shared_ptr<const BlendedSurface> surface);

}  // namespace carreau::atlas
