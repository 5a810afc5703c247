// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/bezier/bezier_patch.h"

#include <array>
#include <type_traits>

namespace carreau {
namespace {

/// Bernstein polynomials of a degree at t, [0], and their first and second derivatives.
using Basis = std::array<std::array<double, largest_bezier_degree + 1>, 3>;

/// B_i^k = (1 - t) B_i^(k-1) + t B_(i-1)^(k-1); derivatives are differences of derivatives of lower degrees. `Degree`:
/// int, or a constant of the compiler.
template <typename Degree>
void bernstein_of(Degree degree, double t, int order, Basis& basis) {
  std::array<double, largest_bezier_degree + 1>& b = basis[0];
  b[0] = 1;
  for (int i = 1; i <= degree; ++i) b[i] = 0;
  for (int k = 0; k <= degree; ++k) {
    if (k == degree - 1 && order >= 1)
      for (int i = 0; i <= degree; ++i) basis[1][i] = degree * ((i > 0 ? b[i - 1] : 0) - (i < degree ? b[i] : 0));
    if (k == degree - 2 && order >= 2)
      for (int i = 0; i <= degree; ++i)
        basis[2][i] = degree * (degree - 1) *
                      ((i > 1 ? b[i - 2] : 0) - (i > 0 && i < degree ? 2 * b[i - 1] : 0) + (i < degree - 1 ? b[i] : 0));
    if (k == degree) break;
    for (int i = k + 1; i > 0; --i) b[i] = (i <= k ? (1 - t) * b[i] : 0) + t * b[i - 1];
    b[0] *= 1 - t;
  }
  if (degree < 2) basis[2].fill(0);
}

void bernstein(int degree, double t, int order, Basis& basis) {
  switch (degree) {
    case 2:
      return bernstein_of(std::integral_constant<int, 2>{}, t, order, basis);
    case 3:
      return bernstein_of(std::integral_constant<int, 3>{}, t, order, basis);
    default:
      return bernstein_of(degree, t, order, basis);
  }
}

Vec3 sum(const BezierPatch& patch, const Basis& u, int du, const Basis& v, int dv) {
  double x = 0, y = 0, z = 0;
  const Vec3* point = patch.control.data();
  for (int i = 0; i <= patch.m; ++i)
    for (int j = 0; j <= patch.n; ++j, ++point) {
      const double weight = u[du][i] * v[dv][j];
      x += weight * point->x(), y += weight * point->y(), z += weight * point->z();
    }
  return {x, y, z};
}

/// All six sums in one pass over the control points, two at a time, each in the order of sum().
void sum_all(const BezierPatch& patch, const Basis& u, const Basis& v, SurfaceJet& jet) {
  using Pair [[gnu::vector_size(16)]] = double;
  struct Three {
    Pair p, q, r;
  };
  std::array<Three, largest_bezier_degree + 1> across;
  for (int j = 0; j <= patch.n; ++j) across[j] = Three{Pair{v[0][j], v[0][j]}, Pair{v[1][j], v[0][j]}, Pair{v[1][j], v[2][j]}};
  Three x{}, y{}, z{};
  const auto add = [](Three& to, const Three& weight, double by) { to.p += weight.p * by, to.q += weight.q * by, to.r += weight.r * by; };
  const Vec3* point = patch.control.data();
  for (int i = 0; i <= patch.m; ++i) {
    const Three along{{u[0][i], u[1][i]}, {u[0][i], u[2][i]}, {u[1][i], u[0][i]}};
    for (int j = 0; j <= patch.n; ++j, ++point) {
      const Three weight{along.p * across[j].p, along.q * across[j].q, along.r * across[j].r};
      add(x, weight, point->x()), add(y, weight, point->y()), add(z, weight, point->z());
    }
  }
  jet.s = {x.p[0], y.p[0], z.p[0]}, jet.su = {x.p[1], y.p[1], z.p[1]};
  jet.sv = {x.q[0], y.q[0], z.q[0]}, jet.suu = {x.q[1], y.q[1], z.q[1]};
  jet.suv = {x.r[0], y.r[0], z.r[0]}, jet.svv = {x.r[1], y.r[1], z.r[1]};
}

/// The position and the first derivatives in one pass, each in the order of sum().
void sum_first(const BezierPatch& patch, const Basis& u, const Basis& v, SurfaceJet& jet) {
  using Pair [[gnu::vector_size(16)]] = double;
  Pair x{}, y{}, z{}, xy_v{};  // at [0]: of the position, at [1]: along u
  double z_v = 0;
  const Vec3* point = patch.control.data();
  for (int i = 0; i <= patch.m; ++i) {
    const Pair along{u[0][i], u[1][i]};
    for (int j = 0; j <= patch.n; ++j, ++point) {
      const Pair weight = along * v[0][j];
      const double weight_v = u[0][i] * v[1][j];
      x += weight * point->x(), y += weight * point->y(), z += weight * point->z();
      xy_v += weight_v * Pair{point->x(), point->y()}, z_v += weight_v * point->z();
    }
  }
  jet.s = {x[0], y[0], z[0]}, jet.su = {x[1], y[1], z[1]}, jet.sv = {xy_v[0], xy_v[1], z_v};
}

}  // namespace

void evaluate(const BezierPatch& patch, unsigned want, const Vec2& uv, SurfaceJet& jet) {
  const int order = (want & want_second) != 0 ? 2 : (want & want_first) != 0 ? 1 : 0;
  Basis u, v;
  bernstein(patch.m, uv.x(), order, u);
  bernstein(patch.n, uv.y(), order, v);
  constexpr unsigned everything = want_position | want_first | want_second;
  if ((want & everything) == everything) return sum_all(patch, u, v, jet);
  if ((want & everything) == (want_position | want_first)) return sum_first(patch, u, v, jet);
  if ((want & want_position) != 0) jet.s = sum(patch, u, 0, v, 0);
  if ((want & want_first) != 0) jet.su = sum(patch, u, 1, v, 0), jet.sv = sum(patch, u, 0, v, 1);
  if ((want & want_second) != 0)
    jet.suu = sum(patch, u, 2, v, 0), jet.suv = sum(patch, u, 1, v, 1), jet.svv = sum(patch, u, 0, v, 2);
}

}  // namespace carreau
