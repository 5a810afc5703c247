// SPDX-License-Identifier: BSD-3-Clause
// Patches of a molecular surface as an evaluator of the engine.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "cad/continued_cad.h"

namespace carreau::molecule {

/// One face: a parametric surface whose normal Su x Sv points outwards, and its curves, the face on their left.
class Patch {
 public:
  virtual ~Patch() = default;
  /// All derivatives to order two.
  [[nodiscard]] virtual SurfaceJet surface(const Vec2& uv) const = 0;
  /// The smaller radius of curvature.
  [[nodiscard]] virtual double radius(const Vec2& uv) const = 0;
  [[nodiscard]] virtual std::size_t curve_count() const = 0;
  [[nodiscard]] virtual Interval interval(std::size_t curve) const = 0;
  [[nodiscard]] virtual CurveJet curve(std::size_t curve, double t) const = 0;
  /// Radius of a curve in space.
  [[nodiscard]] virtual double curve_radius(std::size_t curve) const = 0;
};

class PatchCad final : public Cad, public ContinuedCad {
 public:
  /// `ref` must differ from the references of earlier patches. Not while others evaluate.
  void add(int ref, std::unique_ptr<const Patch> patch);

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override;
  Interval curve_interval(int face, int ic) override;
  CurveJet curve(int face, int ic, unsigned want, double t) override;
  std::optional<double> surface_radius(int face, Vec2 uv) override;
  std::optional<double> curve_radius(int face, int ic, double t) override;
  [[nodiscard]] bool reentrant() const noexcept override { return true; }
  /// Charts of spheres and of tori have no end.
  [[nodiscard]] bool is_continued(int) const noexcept override { return true; }

 private:
  [[nodiscard]] const Patch& patch(int face) const;
  [[nodiscard]] std::size_t rank(int face, int ic) const;

  std::unordered_map<int, std::unique_ptr<const Patch>> patches_;
};

}  // namespace carreau::molecule
