// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/cubic_piece.h"

#include <algorithm>
#include <cmath>

#include "support/error.h"

namespace carreau {

namespace {

/// Real roots of p + q t + r t^2 strictly inside (a, b), ascending. A constant has no root, and a double root counts
/// once.
struct Roots {
  int n = 0;
  std::array<double, 2> t{};
};

Roots roots_inside(double p, double q, double r, double a, double b) noexcept {
  Roots found;
  const auto take = [&](double t) {
    if (t > a && t < b && (found.n == 0 || t != found.t[0])) found.t[found.n++] = t;
  };
  const double discriminant = q * q - 4 * p * r;
  if (r == 0) {
    if (q != 0) take(-p / q);
  } else if (discriminant >= 0) {
    const double w = -(q + std::copysign(std::sqrt(discriminant), q)) / 2;  // without cancellation
    take(w / r);
    if (w != 0) take(p / w);
  }
  if (found.n == 2 && found.t[0] > found.t[1]) std::swap(found.t[0], found.t[1]);
  return found;
}

/// Halving and cutting at extrema ends long before this depth: each cut leaves less than half of the bend (README).
constexpr int deepest = 60;

class Subdivision {
 public:
  Subdivision(const CubicPiece& piece, double eps) : piece_(piece), eps_(eps) {}

  void cut(double a, double b, int depth) {
    const Vec2 from = piece_.at(a);
    const Vec2 chord = piece_.at(b) - from;
    const double d = norm(chord);
    // A closed piece has no chord as direction; any direction serves to cut it.
    const Vec2 along = d > 0 ? Vec2(chord / d) : Vec2{1, 0};
    const auto height = [&](double t) { return std::abs(cross(along, Vec2(piece_.at(t) - from))); };
    // g_y' = cross(along, f')  (RR-2818 sec. 3.4)
    const Roots extrema =
        roots_inside(cross(along, piece_.a[1]), 2 * cross(along, piece_.a[2]), 3 * cross(along, piece_.a[3]), a, b);
    double bend = 0;
    for (int i = 0; i < extrema.n; ++i) bend += height(extrema.t[i]);
    if (extrema.n == 0 || !(bend > eps_ * d) || depth == deepest) return;
    double before = a;
    for (int i = 0; i < extrema.n; ++i) {
      cut(before, extrema.t[i], depth + 1);
      cuts.push_back(extrema.t[i]);
      before = extrema.t[i];
    }
    cut(before, b, depth + 1);
  }

  std::vector<double> cuts;

 private:
  const CubicPiece& piece_;
  double eps_;
};

/// Sum S and product P of the parameters of a double point (RR-2818 sec. 3.6).
struct DoublePoint {
  double sum = 0, product = 0;
};

std::optional<DoublePoint> double_point(const CubicPiece& piece) noexcept {
  const Vec2 &a1 = piece.a[1], &a2 = piece.a[2], &a3 = piece.a[3];
  const double d = cross(a3, a2);
  if (d == 0) return std::nullopt;
  const double s = (a1.x() * a3.y() - a3.x() * a1.y()) / d;
  const int k = std::abs(a3.x()) >= std::abs(a3.y()) ? 0 : 1;  // one of them is not 0, since d is not
  return DoublePoint{s, (a1[k] + a2[k] * s + a3[k] * s * s) / a3[k]};
}

}  // namespace

CubicPiece piece_between(const Vec2& b, const Vec2& c, const std::optional<Vec2>& tangent_b,
                         const std::optional<Vec2>& tangent_c) noexcept {
  const Vec2 chord = c - b, none{0, 0};
  if (tangent_b && tangent_c)
    return {{b, *tangent_b, 3 * chord - 2 * *tangent_b - *tangent_c, -2 * chord + *tangent_b + *tangent_c}};
  if (tangent_b) return {{b, *tangent_b, chord - *tangent_b, none}};
  if (tangent_c) return {{b, 2 * chord - *tangent_c, *tangent_c - chord, none}};
  return {{b, chord, none, none}};
}

std::optional<PieceLoop> loop_of(const CubicPiece& piece) noexcept {
  const std::optional<DoublePoint> found = double_point(piece);
  if (!found) return std::nullopt;
  const double discriminant = found->sum * found->sum - 4 * found->product;
  if (!(discriminant > 0)) return std::nullopt;
  const double root = std::sqrt(discriminant);
  const double t1 = (found->sum - root) / 2, t2 = (found->sum + root) / 2;
  constexpr double rounding = 1e-12;  // of parameters of a piece whose ends are one point
  if (!(t1 >= -rounding && t2 <= 1 + rounding && t1 < t2)) return std::nullopt;
  const PieceLoop loop{std::max(t1, 0.0), std::min(t2, 1.0), {}};
  return PieceLoop{loop.t1, loop.t2, piece.at(loop.t1)};
}

std::optional<double> cusp_of(const CubicPiece& piece) noexcept {
  const Vec2 &a1 = piece.a[1], &a2 = piece.a[2], &a3 = piece.a[3];
  // f' vanishes where both of its coordinates do: candidates are the extrema of the coordinate that bends more.
  const int k = std::abs(a2.x()) + std::abs(a3.x()) >= std::abs(a2.y()) + std::abs(a3.y()) ? 0 : 1;
  const Roots stops = roots_inside(a1[k], 2 * a2[k], 3 * a3[k], 0, 1);
  const double scale = norm(a1) + 2 * norm(a2) + 3 * norm(a3);
  constexpr double rounding = 1e-9;  // relative: a double root is known to the root of the precision
  for (int i = 0; i < stops.n; ++i)
    if (norm(piece.first(stops.t[i])) <= rounding * scale) return stops.t[i];
  return std::nullopt;
}

bool turns_back(const CubicPiece& piece) noexcept {
  const Vec2 chord = piece.at(1) - piece.a[0];
  if (!(norm(chord) > 0)) return true;
  const double p = dot(chord, piece.a[1]), q = 2 * dot(chord, piece.a[2]), r = 3 * dot(chord, piece.a[3]);
  const auto slope = [&](double t) { return p + t * (q + t * r); };
  if (slope(0) < 0 || slope(1) < 0) return true;
  const double lowest = r != 0 ? -q / (2 * r) : 0;
  return lowest > 0 && lowest < 1 && slope(lowest) < 0;
}

std::vector<double> subdivide(const CubicPiece& piece, double eps) {
  if (!(eps > 0)) throw InvalidArgument("the tolerance of a subdivision must be positive");
  Subdivision subdivision(piece, eps);
  subdivision.cut(0, 1, 0);
  return std::move(subdivision.cuts);
}

}  // namespace carreau
