// SPDX-License-Identifier: BSD-3-Clause
#include "cad/fundamental_forms.h"

#include <algorithm>
#include <cmath>

#include "metric/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::degenerate;

/// Su x Sv, or nothing where the parametrisation is degenerate.
std::optional<Vec3> regular_normal(const SurfaceJet& jet) noexcept {
  const FirstForm form = first_form(jet);
  const Vec3 n = cross(jet.su, jet.sv);
  const double det = dot(n, n);  // E G - F^2 without its cancellation
  // Written so that NaN fails.
  if (!(form.e > collapsed * form.g) || !(form.g > collapsed * form.e) || !(det > parallel * form.e * form.g))
    return {};
  if (!std::isfinite(det)) return {};
  return n;
}

}  // namespace

double PrincipalFrame::largest() const noexcept { return std::max(std::abs(k1), std::abs(k2)); }

FirstForm first_form(const SurfaceJet& jet) noexcept {
  return {dot(jet.su, jet.su), dot(jet.su, jet.sv), dot(jet.sv, jet.sv)};
}

std::optional<Vec3> unit_normal(const SurfaceJet& jet) noexcept {
  const std::optional<Vec3> n = regular_normal(jet);
  if (!n) return {};
  return (1 / norm(*n)) * *n;
}

std::optional<SecondForm> second_form(const SurfaceJet& jet) noexcept {
  const std::optional<Vec3> normal = unit_normal(jet);
  if (!normal) return {};
  const SecondForm form{dot(*normal, jet.suu), dot(*normal, jet.suv), dot(*normal, jet.svv)};
  if (!std::isfinite(form.l) || !std::isfinite(form.m) || !std::isfinite(form.n)) return {};
  return form;
}

std::optional<PrincipalFrame> principal_frame(const SurfaceJet& jet) noexcept {
  const std::optional<Vec3> cross_product = regular_normal(jet);
  const std::optional<SecondForm> second = second_form(jet);
  if (!cross_product || !second) return {};
  const FirstForm first = first_form(jet);
  const double length_u = std::sqrt(first.e);
  const double height_v = norm(*cross_product) / length_u;  // of Sv above Su
  const double shear = first.f / first.e;
  PrincipalFrame frame;
  frame.normal = (1 / norm(*cross_product)) * *cross_product;
  const Vec3 e1 = (1 / length_u) * jet.su;
  const Vec3 e2 = cross(frame.normal, e1);

  // The second form in the frame (e1, e2): (a b; b c). Its eigenvalues are (a + c) / 2 +- hypot((a - c) / 2, b), which
  // has no cancellation at umbilics, unlike H +- sqrt(H^2 - K).
  const double a = second->l / first.e;
  const double b = (second->m - shear * second->l) / (length_u * height_v);
  const double c = (second->n - 2 * shear * second->m + shear * shear * second->l) / (height_v * height_v);
  const double middle = (a + c) / 2, half = (a - c) / 2, radius = std::hypot(half, b);
  if (!std::isfinite(middle) || !std::isfinite(radius)) return {};
  frame.k1 = middle + radius;
  frame.k2 = middle - radius;

  const double angle = radius > 0 ? std::atan2(b, half) / 2 : 0;  // of w1 from e1
  const double cosine = std::cos(angle), sine = std::sin(angle);
  frame.w1 = cosine * e1 + sine * e2;
  frame.w2 = cosine * e2 - sine * e1;
  // e1 = Su / |Su|, e2 = (Sv - shear Su) / height.
  frame.x1 = {cosine / length_u - sine * shear / height_v, sine / height_v};
  frame.x2 = {-sine / length_u - cosine * shear / height_v, cosine / height_v};
  return frame;
}

double normal_curvature(const FirstForm& first, const SecondForm& second, const Vec2& x) noexcept {
  return (second.l * x.x() * x.x() + 2 * second.m * x.x() * x.y() + second.n * x.y() * x.y()) /
         (first.e * x.x() * x.x() + 2 * first.f * x.x() * x.y() + first.g * x.y() * x.y());
}

}  // namespace carreau
