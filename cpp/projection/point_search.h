// SPDX-License-Identifier: BSD-3-Clause
// The search for the closest point of several entities, one evaluation at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "projection/descent.h"
#include "projection/face_leaves.h"

namespace carreau::projection {

/// A place to be evaluated: of a face, or of a curve in it.
struct PlaceRequest {
  int face = 0;    ///< index in the model
  int curve = -1;  ///< index in the face; -1: none
  Vec2 parameters;
};

/// A piece that may hold the closest point.
struct Candidate {
  std::int32_t entity = 0, piece = 0;  // index, and rank in it
  Vec2 start;  // of a leaf of a face, its share, until it is solved
  double distance = 0, error = 0;
  double floor = 0;     // no place is nearer, by the box of the leaf
  bool solved = false;  // `start` is the nearest place

  /// A lower bound, with room for rounding: the candidate itself may have given the upper bound.
  [[nodiscard]] double least() const noexcept { return std::max(floor, (1 - 1e-12) * (distance - error)); }
};

/// Searches of neighbouring points: they share memory, and each begins in the piece that its predecessor ended in.
struct SearchGroup {
  std::vector<Candidate> kept;   // of all searches
  std::vector<Candidate> trial;  // of the search that is made
  std::int32_t entity = -1, piece = 0;  // of the predecessor; -1: none is known
  Vec2 place;

  // These pieces hold the closest points of all points in a ball.
  struct Near {
    const PieceTree::Piece* piece = nullptr;
    double distance = 0;  // of the centre, a lower bound
  };
  Vec3 centre;
  double reach = -1;
  std::vector<Near> near;
};

class PointSearch {
 public:
  /// Seeks for the first of the points; others follow. The group must outlive the search.
  PointSearch(const PieceTree& tree, std::span<const Vec3> points, double diagonal, SearchGroup& group);

  /// False when the search has ended.
  [[nodiscard]] bool goes_on() const noexcept { return next_ < end_; }
  [[nodiscard]] PlaceRequest request() const;
  /// Takes the values at the request; of a curve, the position along it and its derivatives, as if v had no influence. `cad`: for the domains
  /// of faces.
  void take(const SurfaceJet& jet, Cad& cad);

  struct Found {
    std::int32_t entity = -1;  ///< rank of the entity; -1: none was found
    PlaceRequest place;        ///< on a curve its t
    Vec3 xyz;
    double square = 0;  ///< of the distance
  };
  [[nodiscard]] const Found& best() const noexcept { return best_; }

 private:
  void begin_at_predecessor(double& bound);
  void collect(std::span<const Vec3> points, double bound);
  void look_at(const PieceTree::Piece& piece, double square, bool is_near, double& bound);
  void look_at(const CurveLeaf& curve, Candidate& candidate, double& bound);
  void solve(Candidate& candidate, const NearestSample* sample, double& bound) const;
  void refine(double& bound);
  void begin();
  [[nodiscard]] bool leads_to_best(const Candidate& c) const;
  [[nodiscard]] const Pieces& pieces_of(const Candidate& c) const { return tree_->of(c.entity); }
  [[nodiscard]] const CurveLeaf* curve_of(const Candidate& c) const {
    const Pieces& pieces = pieces_of(c);
    const auto k = static_cast<std::size_t>(c.piece);
    return k < pieces.leaves.size() ? nullptr : &pieces.curves[k - pieces.leaves.size()];
  }

  [[nodiscard]] const Candidate& candidate() const { return group_->kept[next_]; }

  const PieceTree* tree_;
  SearchGroup* group_;
  Vec3 x_;
  double diagonal_;
  double nearest_sample_;
  std::size_t next_ = 0, end_ = 0;  // candidates of the group
  Descent descent_;
  bool in_leaf_ = false;  // the descent stays in the leaf of its start
  Found best_;
};

}  // namespace carreau::projection
