// SPDX-License-Identifier: BSD-3-Clause
#include "size/geometric_metric.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cad/fundamental_forms.h"
#include "support/infinity.h"

namespace carreau {

namespace {

double radians(double degrees) noexcept { return degrees * std::numbers::pi / 180; }

/// Chord of a circle of radius rho at sagitta delta: 2 sqrt(delta (2 rho - delta)) (HDR eq. 2.30), roots first, so that
/// no large radius overflows.
double chord(double delta, double rho) noexcept {
  if (!std::isfinite(rho)) return infinity;
  return 2 * std::sqrt(delta) * std::sqrt(2 * rho - delta);
}

double chord_size(const GeometricRule& rule, double rho) noexcept {
  return rule.chord_factor * chord(rule.eps0, std::max(rho, rule.eps0));
}

double angle_size(const GeometricRule& rule, double rho) noexcept {
  return rule.angle_factor * (2 * std::sin(radians(rule.angle_deg)) * rho);
}

/// HDR eq. 4.40: the sagitta delta1 of the smallest radius in every direction.
double reduced_angle_size(const GeometricRule& rule, double rho1, double rho2) noexcept {
  if (!std::isfinite(rho1)) return infinity;
  const double half = std::sin(radians(rule.angle_deg) / 2);
  const double delta1 = 2 * half * half * rho1;  // (1 - cos eps1) rho1
  return rule.angle_factor * chord(delta1, rho2);
}

/// RR-2928 eq. 41 times alpha.
double cut_radius_size(const GeometricRule& rule, double rho1, double rho2) noexcept {
  if (!std::isfinite(rho1) || !std::isfinite(rho2)) return infinity;
  return angle_size(rule, std::sqrt(rho1) * std::sqrt(2 * rho2 - rho1));
}

}  // namespace

double geometric_size(const GeometricRule& rule, double radius) noexcept {
  switch (rule.criterion) {
    case GeometricCriterion::chord:
      return chord_size(rule, radius);
    case GeometricCriterion::both:
      return std::min(chord_size(rule, radius), angle_size(rule, radius));
    default:
      return angle_size(rule, radius);
  }
}

std::array<double, 2> geometric_sizes(const GeometricRule& rule, double rho1, double rho2) noexcept {
  const double h1 = geometric_size(rule, rho1);
  if (!rule.anisotropic) return {h1, h1};
  double h2 = infinity;
  switch (rule.criterion) {
    case GeometricCriterion::chord:
      h2 = chord_size(rule, rho2);
      break;
    case GeometricCriterion::both:
      h2 = std::min(chord_size(rule, rho2), reduced_angle_size(rule, rho1, rho2));
      break;
    case GeometricCriterion::angle:
      h2 = reduced_angle_size(rule, rho1, rho2);
      break;
    case GeometricCriterion::radii:
      h2 = cut_radius_size(rule, rho1, rho2);
      break;
  }
  return {h1, std::max(h1, h2)};  // equal radii: one formula may be an ulp below the other
}

std::optional<DirectedSizes> geometric_sizes(const GeometricRule& rule, const SurfaceJet& jet) noexcept {
  const std::optional<PrincipalFrame> frame = principal_frame(jet);
  if (!frame) return {};
  const auto radius = [](double k) { return k != 0 ? 1 / std::abs(k) : infinity; };
  const double r1 = radius(frame->k1), r2 = radius(frame->k2);
  const bool first = r1 <= r2;
  const auto [h1, h2] = geometric_sizes(rule, first ? r1 : r2, first ? r2 : r1);
  if (first) return DirectedSizes{h1, h2, frame->w1, frame->w2};
  return DirectedSizes{h1, h2, frame->w2, -1.0 * frame->w1};
}

}  // namespace carreau
