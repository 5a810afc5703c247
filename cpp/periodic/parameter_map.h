// SPDX-License-Identifier: BSD-3-Clause
// From the parameters of a face to the parameters of its image.
#pragma once

#include <array>
#include <vector>

#include "periodic/match_faces.h"
#include "size/size_rules.h"

namespace carreau {

/// Guesses the parameters of images: by the affine map that fits the boundaries, which is exact for planes, cylinders and
/// equal parametrisations, else by the nearest point of the boundary.
class ParameterMap {
 public:
  ParameterMap() = default;
  ParameterMap(const CurveModel& model, const FacePair& pair);
  /// The same from places of the master and places of the slave.
  ParameterMap(std::vector<Vec2> from, std::vector<Vec2> to);

  [[nodiscard]] bool is_affine() const noexcept { return affine_; }
  [[nodiscard]] Vec2 guess(const Vec2& uv) const;

 private:
  std::vector<Vec2> from_, to_;
  bool affine_ = false;
  std::array<Vec2, 2> row_;
  Vec2 middle_{0, 0}, image_{0, 0};
};

/// The sizes of slaves count for their masters.
class SlaveSizes final : public JoinedFaces {
 public:
  SlaveSizes(const CurveModel& model, const std::vector<FacePair>& pairs);
  void intersect(const SizeRules& rules, int face, std::span<const Vec2> uv, std::span<Metric2> metric) const override;
  void lower(const SizeRules& rules, int face, std::span<const Vec2> uv, std::span<double> h) const override;

 private:
  struct Slave {
    const FacePair* pair;
    ParameterMap map;
  };
  template <typename Use>
  void for_images(int face, std::span<const Vec2> uv, unsigned want, const Use& use) const;

  CurveModel model_;
  std::vector<std::vector<Slave>> slaves_;  // by face
};

}  // namespace carreau
