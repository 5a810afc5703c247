// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/grid/coons_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace carreau::grid {

namespace {

/// The polynomials of Hermite of HDR eq. 4.90 over an interval of length h, in the order of the rows of eq. 4.91, and
/// their derivatives.
struct Hermite {
  std::array<double, 4> f, first, second;

  Hermite(double t, double h)
      : f{(2 * t - 3) * t * t + 1, (3 - 2 * t) * t * t, h * ((t - 2) * t + 1) * t, h * (t - 1) * t * t},
        first{6 * (t - 1) * t / h, 6 * (1 - t) * t / h, (3 * t - 4) * t + 1, (3 * t - 2) * t},
        second{(12 * t - 6) / (h * h), (6 - 12 * t) / (h * h), (6 * t - 4) / h, (6 * t - 2) / h} {}
};

struct Place {
  std::size_t cell;
  double t, length;
};

Place place_in(const std::vector<double>& knots, std::size_t cell, double x) {
  const double length = knots[cell + 1] - knots[cell];
  return {cell, (x - knots[cell]) / length, length};
}

Place place_of(const std::vector<double>& knots, double x) {
  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, x);
  return place_in(knots, static_cast<std::size_t>(above - knots.begin()) - 1, x);
}

double outside(const Place& p) { return std::max({0.0, -p.t, p.t - 1}) * p.length; }

/// Moves to the nearest neighbour of a missing cell.
void go_to_neighbour(const CoonsSurface& surface, const Vec2& uv, Place& pu, Place& pv) {
  const Place u = pu, v = pv;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t j = v.cell == 0 ? 0 : v.cell - 1; j <= v.cell + 1 && j + 1 < surface.v.size(); ++j)
    for (std::size_t i = u.cell == 0 ? 0 : u.cell - 1; i <= u.cell + 1 && i + 1 < surface.u.size(); ++i) {
      if (!surface.has_cell(i, j)) continue;
      const Place at_u = place_in(surface.u, i, uv.x()), at_v = place_in(surface.v, j, uv.y());
      const double distance = std::hypot(outside(at_u), outside(at_v));
      if (distance < nearest) nearest = distance, pu = at_u, pv = at_v;
    }
}

using Row = std::array<Vec3, 4>;

void add_products(const Row& a, const Hermite& v, double factor, Vec3& value, Vec3& first, Vec3& second) {
  for (std::size_t k = 0; k < 4; ++k) {
    value += factor * v.f[k] * a[k];
    first += factor * v.first[k] * a[k];
    second += factor * v.second[k] * a[k];
  }
}

}  // namespace

SurfaceJet CoonsSurface::at(const Vec2& uv) const {
  Place pu = place_of(u, uv.x()), pv = place_of(v, uv.y());
  if (!has_cell(pu.cell, pv.cell)) go_to_neighbour(*this, uv, pu, pv);
  const Hermite hu(pu.t, pu.length), hv(pv.t, pv.length);
  const Node &p00 = node(pu.cell, pv.cell), &p10 = node(pu.cell + 1, pv.cell), &p01 = node(pu.cell, pv.cell + 1),
             &p11 = node(pu.cell + 1, pv.cell + 1);
  const std::array<Row, 4> a{Row{p00.s, p01.s, p00.sv, p01.sv}, Row{p10.s, p11.s, p10.sv, p11.sv},
                             Row{p00.su, p01.su, p00.suv, p01.suv}, Row{p10.su, p11.su, p10.suv, p11.suv}};
  SurfaceJet jet;
  Vec3 unused;
  for (std::size_t k = 0; k < 4; ++k) {
    add_products(a[k], hv, hu.f[k], jet.s, jet.sv, jet.svv);
    add_products(a[k], hv, hu.first[k], jet.su, jet.suv, unused);
    add_products(a[k], hv, hu.second[k], jet.suu, unused, unused);
  }
  return jet;
}

}  // namespace carreau::grid
