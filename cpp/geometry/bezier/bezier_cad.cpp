// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/bezier/bezier_cad.h"

#include "cad/fundamental_forms.h"
#include "support/error.h"

namespace carreau {
namespace {

constexpr unsigned all = want_position | want_first | want_second;
/// Corners of the unit square, counterclockwise, and the first one again.
constexpr double corners[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};

void check_side(const BezierPatch& /*of*/, int face, int ic) {
  if (ic < 1 || ic > 4) throw InvalidArgument(Where{.face = face, .curve_index = ic}, "a Bezier patch has four sides");
}

}  // namespace

const BezierPatch& BezierCad::patch(int face) const {
  if (face < 1 || static_cast<std::size_t>(face) > patches_.size())
    throw InvalidArgument(Where{.face = face}, "there is no such Bezier patch");
  return patches_[static_cast<std::size_t>(face - 1)];
}

void BezierCad::surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  const BezierPatch& p = patch(face);
  for (std::size_t i = 0; i < uv.size(); ++i) evaluate(p, want, uv[i], out[i]);
}

Interval BezierCad::curve_interval(int face, int ic) {
  check_side(patch(face), face, ic);
  return {0, 1};
}

CurveJet BezierCad::curve(int face, int ic, unsigned /*want*/, double t) {
  check_side(patch(face), face, ic);
  const double *from = corners[ic - 1], *to = corners[ic];
  CurveJet jet;
  for (Eigen::Index i = 0; i < 2; ++i) jet.c[i] = (1 - t) * from[i] + t * to[i], jet.ct[i] = to[i] - from[i];
  return jet;
}

std::optional<double> BezierCad::surface_radius(int face, Vec2 uv) {
  SurfaceJet jet;
  evaluate(patch(face), all, uv, jet);
  const std::optional<PrincipalFrame> frame = principal_frame(jet);
  if (!frame || !(frame->largest() > 0)) return {};
  return 1 / frame->largest();
}

std::optional<double> BezierCad::curve_radius(int face, int ic, double t) {
  const CurveJet c = curve(face, ic, all, t);
  SurfaceJet s;
  evaluate(patch(face), all, c.c, s);
  const Vec3 first = c.ct.x() * s.su + c.ct.y() * s.sv;
  const Vec3 second = c.ct.x() * c.ct.x() * s.suu + 2 * c.ct.x() * c.ct.y() * s.suv + c.ct.y() * c.ct.y() * s.svv;
  const double speed = norm(first), bend = norm(cross(first, second));
  if (!(speed > 0) || !(bend > 0)) return {};
  return speed * speed * speed / bend;
}

}  // namespace carreau
