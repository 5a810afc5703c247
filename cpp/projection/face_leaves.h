// SPDX-License-Identifier: BSD-3-Clause
// Pieces of faces and of curves that are nearly quadratic, in trees of boxes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "cad/cad.h"
#include "cad/parameter_domain.h"
#include "curve/support.h"
#include "model/model.h"
#include "projection/restricted_step.h"
#include "support/box_tree.h"
#include "support/monitor.h"

namespace carreau::projection {

/// A box in any direction: nearly flat pieces fill it better than a box along the coordinates.
struct TurnedBox {
  Vec3 origin;
  std::array<Vec3, 3> axes;  ///< orthonormal
  Vec3 low, high;            ///< along the axes, from the origin
  Vec2 scale;                ///< the inverse of the first two lengths

  /// Its nearest point: the square of the distance, and the place along the first two axes, from 0 to 1.
  struct Nearest {
    double square;
    Vec2 share;
  };
  [[nodiscard]] Nearest nearest(const Vec3& x) const noexcept {
    const Vec3 r = x - origin;
    Vec3 inside;
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      const double at = dot(r, axes[static_cast<std::size_t>(k)]), low_side = low[k] > at ? low[k] : at;
      inside[k] = low_side < high[k] ? low_side : high[k];
      square += (at - inside[k]) * (at - inside[k]);
    }
    const auto share = [&](int k) { return (inside[k] - low[k]) * scale[k]; };
    return {square, {share(0), share(1)}};
  }
  [[nodiscard]] double squared_distance(const Vec3& x) const noexcept { return nearest(x).square; }
};

/// Coefficients of u^i v^j in a bicubic polynomial, two neighbours in j together: coordinate k has them from 8 k + 2 i on.
struct BicubicTerms {
  using Pair [[gnu::vector_size(16)]] = double;
  std::array<Pair, 24> pairs{};

  void set(int i, int j, const Vec3& to) noexcept {
    for (int k = 0; k < 3; ++k) pairs[static_cast<std::size_t>(8 * k + 2 * i + j / 2)][j % 2] = to[k];
  }
  [[nodiscard]] Vec3 at(int i, int j) const noexcept {
    const auto n = static_cast<std::size_t>(2 * i + j / 2);
    return {pairs[n][j % 2], pairs[8 + n][j % 2], pairs[16 + n][j % 2]};
  }
};

/// A piece of a face, as a bicubic interpolation; a triangle, as a quadratic one.
struct SurfaceLeaf {
  Region region;           ///< of (u, v)
  std::array<Vec3, 9> at;  ///< at low, the middle and high of u (first) and v
  double error = 0;        ///< distance of the surface from the interpolation
  double size = 0;         ///< diameter in space
  double cover = 0;        ///< no point of the leaf is farther from the nearest of the nine places
  bool cut = false;        ///< the boundary of the domain crosses it
  BicubicTerms terms = {};  ///< of the interpolation, from 0 to 1
  /// Half of the squared distance differs from its expansion of second order after a way w by at most (bend + third * distance) |w|^3.
  double bend = 0, third = 0;
};

/// The piece of a curve over an edge of its support.
struct CurveLeaf {
  int face = 0, curve = 0;  ///< index in the model, and in the face
  double t0 = 0, t1 = 0;
  double a = 0, b = 0;  ///< interval of the whole curve
  Vec3 from, to;
  double error = 0;  ///< distance of the curve from the edge
};

/// The nearest of the nine places, those inside of a triangle alone, and the square of its distance.
struct NearestSample {
  std::size_t rank = 0;
  double square = 0;
};
NearestSample nearest_sample(const SurfaceLeaf& leaf, const Vec3& x);
inline Vec2 place_of(const NearestSample& sample) { return {static_cast<double>(sample.rank % 3) / 2, static_cast<double>(sample.rank / 3) / 2}; }

/// A place of a leaf that is nearest to a point, on the interpolation.
struct LeafPlace {
  Vec2 parameters;  ///< (u, v), or t and 0
  double distance = 0;
  double slack = 0;  ///< of the distance: the search ended so near
};
/// Begins at `from`, in shares of the region, or at the sample if it is nearer; may be null. Ends early if the distance is certainly larger
/// than `bound`.
LeafPlace nearest_on(const SurfaceLeaf& leaf, const Vec3& x, const Vec2& from, const NearestSample* sample, double bound);
LeafPlace nearest_on(const CurveLeaf& leaf, const Vec3& x);

/// The pieces of a face with its boundary, or of a curve. The rank of a piece counts the leaves, then the curves.
struct Pieces {
  std::vector<SurfaceLeaf> leaves;
  std::vector<CurveLeaf> curves;
  std::vector<BoxTree::Box> boxes;  // of the leaves, then of the curves
  std::vector<TurnedBox> turned;    // of the leaves
  BoxTree::Box box;
  Region region;                        ///< of a face; of triangles each leaf has its own
  std::optional<TrimmedDomain> domain;  ///< of a face whose domain is not a box
  bool triangles = false;
};

/// A tree of the pieces of some entities.
class PieceTree {
 public:
  struct Piece {
    BoxTree::Box box;
    TurnedBox turned;                   ///< of a leaf of a face
    std::int32_t entity = 0, rank = 0;  ///< index among the entities, and of the piece in its entity
    bool is_leaf = false;
  };
  PieceTree() = default;
  /// The pieces of all entities, or of entity `only` if it is not negative.
  PieceTree(std::span<const Pieces> entities, std::int32_t only);

  [[nodiscard]] const Pieces& of(std::int32_t entity) const noexcept { return entities_[static_cast<std::size_t>(entity)]; }
  [[nodiscard]] const BoxTree& boxes() const noexcept { return tree_; }
  [[nodiscard]] std::span<const Piece> pieces(const BoxTree::Node& leaf) const noexcept {
    return std::span(pieces_).subspan(static_cast<std::size_t>(leaf.first), static_cast<std::size_t>(leaf.count));
  }

 private:
  std::span<const Pieces> entities_;
  BoxTree tree_;
  std::vector<Piece> pieces_;  // in the order of the tree
};

/// Evaluates places of a face. Places outside of the domain where the host fails are NaN.
using EvaluateFace = std::function<void(std::span<const Vec2>, std::span<SurfaceJet>)>;

/// The pieces of face `face` (index) of the model. Throws the exceptions of `evaluate`, and Cancelled.
Pieces pieces_of_face(const Model& model, std::size_t face, const std::vector<CurveSupport>& supports, const EvaluateFace& evaluate, Monitor& monitor);
/// The pieces of a face of triangles, whose regions are given.
Pieces pieces_of_triangles(std::span<const Region> regions, const EvaluateFace& evaluate, Monitor& monitor);
Pieces pieces_of_curve(int face, int curve, const CurveSupport& support);

}  // namespace carreau::projection
