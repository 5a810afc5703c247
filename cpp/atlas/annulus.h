// SPDX-License-Identifier: BSD-3-Clause
// An annulus of the plane, described by (tau, phi): from 0 at the inner to 1 at the outer border, and around (Atlas
// sec. 5.3, 5.4).
#pragma once

#include <optional>

#include "atlas/loop.h"
#include "atlas/smooth_borders.h"

namespace carreau::atlas {

struct AnnulusOptions {
  OuterBorder border = OuterBorder::spline;
  /// The outer border is rounded, and the inner one follows by b (end of Atlas sec. 5.4.4): covers more, less like the given inner border.
  bool outer_first = false;
  bool star = false;  ///< one pivot where the inner border is star-shaped
  /// At vertices of the inner border: increasing, the first one again after `period`. Empty: by lengths.
  std::vector<double> phi = {};
  double period = 2 * std::numbers::pi;
};

/// A place of an annulus by its parameters.
template <typename Number>
struct Strata {
  Number tau, phi;
};

class Annulus {
 public:
  /// Throws DomainError with the vertex: a border that crosses itself, no width, parts that no pivots describe.
  Annulus(Polygon inner, Polygon outer, AnnulusOptions options = {});

  [[nodiscard]] const Polygon& inner() const { return inner_; }
  [[nodiscard]] const Polygon& outer() const { return outer_; }
  /// The actual outer border, in place of the given one; inside it.
  [[nodiscard]] const Polygon& described_outer() const { return described_; }
  [[nodiscard]] const Pivots& pivots() const { return chosen_.pivots; }
  [[nodiscard]] PivotChoice pivot_choice() const { return chosen_.how; }
  [[nodiscard]] std::span<const Part> parts() const { return parts_; }
  [[nodiscard]] double period() const { return period_; }

  /// The point at (tau, phi), tau from 0 to 1, any phi.
  template <typename Number>
  [[nodiscard]] Pair<Number> at(const Number& tau, const Number& phi) const;
  /// The parameters of a point; phi starts at the joint of the first pivot and covers one period. Empty outside of the
  /// annulus.
  template <typename Number>
  [[nodiscard]] std::optional<Strata<Number>> find(const Pair<Number>& p) const;
  /// Returns whether p is inside of the annulus' inner border, which is the smooth one (Atlas sec. 5.5.2.2).
  [[nodiscard]] bool encloses(const Vec2& p) const;

 private:
  /// The part that holds p; parts.size() if no part does.
  [[nodiscard]] std::size_t part_around(const Vec2& p) const;

  Polygon inner_, outer_, described_;
  double period_;
  ChosenPivots chosen_;
  std::vector<Part> parts_;
  Polygon chain_;
};

template <typename Number>
Pair<Number> Annulus::at(const Number& tau, const Number& phi) const {
  double x = value_of(phi);
  const Part& part = parts_[part_of(parts_, period_, x)];
  const Number moved = phi + (x - value_of(phi));
  const Number angle = hermite(part.angle_data(interval_of(part.phi, x), tau), moved);
  const Number r = part.radius(tau, angle);
  const Pair<Number> u = part.direction(angle);
  return {part.pivot.x() + r * u[0], part.pivot.y() + r * u[1]};
}

template <typename Number>
std::optional<Strata<Number>> Annulus::find(const Pair<Number>& p) const {
  const std::size_t n = part_around(value_of(p));
  if (n == parts_.size()) return {};
  const Part& part = parts_[n];
  const Pair<Number> polar = part.polar(p);
  const Number tau = part.stratum(polar[1], polar[0]);
  const std::size_t k = interval_of(part.angle, value_of(polar[0]));
  return Strata<Number>{tau, Number(hermite_inverse(part.angle_data(k, tau), polar[0]))};
}

}  // namespace carreau::atlas
