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

/// Entities among which the closest point is sought, with a tree of their boxes.
struct Entities {
  std::vector<const Pieces*> pieces;
  BoxTree tree;
};

/// A place to be evaluated: of a face, or of a curve in it.
struct PlaceRequest {
  int face = 0;    ///< index in the model
  int curve = -1;  ///< index in the face; -1: none
  Vec2 parameters;
};

class PointSearch {
 public:
  /// Seeks in all entities, or in one of them if `only` is not negative. `hint`: a point of these entities, not far from the closest point; null:
  /// none is known.
  PointSearch(const Entities& entities, std::int32_t only, const Vec3& x, double diagonal, const Vec3* hint = nullptr);

  /// A point of the entities near the closest point, as a hint for the next search; null: none is known.
  [[nodiscard]] const Vec3* near_point() const;

  /// False when the search has ended.
  [[nodiscard]] bool goes_on() const noexcept { return next_ < candidates_.size(); }
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
  struct Candidate {
    std::int32_t entity = 0, piece = 0;  // piece: rank among leaves, then curves
    Vec2 start;
    double distance = 0, error = 0;
    double floor = 0;      // no place is nearer, by the box of the leaf
    NearestSample sample;  // of a leaf of a face
    bool solved = false;   // `start` is the nearest place, not a sample

    /// A lower bound, with room for rounding: the candidate itself may have given the upper bound.
    [[nodiscard]] double least() const noexcept { return std::max(floor, (1 - 1e-12) * (distance - error)); }
  };
  void look_at(std::int32_t entity, double& bound);
  void solve(Candidate& candidate, double& bound) const;
  void refine(double& bound);
  void begin();
  [[nodiscard]] bool leads_to_best(const Candidate& c) const;
  [[nodiscard]] const Pieces& pieces_of(const Candidate& c) const { return *entities_->pieces[static_cast<std::size_t>(c.entity)]; }
  [[nodiscard]] const CurveLeaf* curve_of(const Candidate& c) const {
    const Pieces& pieces = pieces_of(c);
    const auto k = static_cast<std::size_t>(c.piece);
    return k < pieces.leaves.size() ? nullptr : &pieces.curves[k - pieces.leaves.size()];
  }

  const Entities* entities_;
  Vec3 x_;
  double diagonal_;
  std::vector<Candidate> candidates_;
  double nearest_sample_;
  std::size_t next_ = 0;
  Descent descent_;
  bool in_leaf_ = false;  // the descent stays in the leaf of its start
  Found best_;
};

}  // namespace carreau::projection
