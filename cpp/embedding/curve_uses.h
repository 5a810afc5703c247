// SPDX-License-Identifier: BSD-3-Clause
// The curves of a model's faces as they stand in each face: places on them, and chords.
#pragma once

#include <cstddef>
#include <vector>

#include "embedding/embedded_curve.h"
#include "model/model.h"
#include "support/vec.h"

namespace carreau::embedding {

/// Evaluates curves of faces: embedded curves, or curves of the host. Refers to its members, which outlive it.
struct CurveUses {
  Cad& cad;
  const Model& model;
  const EmbeddedCurves& curves;

  struct Use {
    std::size_t face = 0, curve = 0;  ///< indices
  };
  struct Place {
    double t = 0, distance = 0;
    Vec2 uv;
    Vec3 xyz, tangent;
  };

  /// Index of the face with a reference. Throws InvalidArgument if the model has none.
  [[nodiscard]] std::size_t index_of(int face) const;
  [[nodiscard]] Interval interval(const Use& use) const;
  /// Null for a curve of the host.
  [[nodiscard]] const EmbeddedCurve* embedded(const Use& use) const;
  [[nodiscard]] CurveJet in_parameters(const Use& use, double t) const;
  [[nodiscard]] Place at(const Use& use, double t) const;
  [[nodiscard]] Place nearest(const Use& use, const Vec3& x) const;
  /// The point nearest to the segments a-y-b among the curves that both faces have. Returns false if they have none.
  bool border(int face, int other, const Vec3& a, const Vec3& b, Vec3& y) const;
  /// Ends of chords that leave the curve by at most a small share of the diagonal.
  [[nodiscard]] std::vector<Vec3> chords(const Use& use, double diagonal) const;
};

}  // namespace carreau::embedding
