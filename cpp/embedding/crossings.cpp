// SPDX-License-Identifier: BSD-3-Clause
#include "embedding/crossings.h"

#include <algorithm>
#include <cmath>

#include "embedding/thresholds.h"
#include "support/rounding_of.h"

namespace carreau::embedding {

namespace {

constexpr int parts_of_span = 4;  // chords of a Hermite span, in which crossings are sought

double lerp1(double p, double q, double w) { return (1 - w) * p + w * q; }

struct Samples {
  std::vector<double> t;
  std::vector<Vec2> uv;
};

Samples samples_of(const EmbeddedCurve& curve, double a, double b) {
  Samples samples;
  const auto add = [&](double t) { samples.t.push_back(t), samples.uv.push_back(curve.at(t).c); };
  add(a);
  for (std::size_t i = 0; i + 1 < curve.t.size(); ++i)
    for (int k = 0; k < parts_of_span; ++k)
      if (const double t = curve.t[i] + (curve.t[i + 1] - curve.t[i]) * k / parts_of_span; t > a && t < b) add(t);
  add(b);
  return samples;
}

/// Shares of two segments at which their lines cross; false if they are parallel or cross beyond the ends.
bool crossing(const Vec2& p, const Vec2& p_end, const Vec2& q, const Vec2& q_end, double& s, double& r) {
  if (std::max(p.x(), p_end.x()) < std::min(q.x(), q_end.x()) || std::max(q.x(), q_end.x()) < std::min(p.x(), p_end.x()) ||
      std::max(p.y(), p_end.y()) < std::min(q.y(), q_end.y()) || std::max(q.y(), q_end.y()) < std::min(p.y(), p_end.y()))
    return false;
  const Vec2 d = p_end - p, e = q_end - q, f = q - p;
  const double det = cross(d, e);
  if (!(std::abs(det) > rounding_of::digits * norm(d) * norm(e))) return false;
  constexpr double beyond = rounding_of::places;
  s = cross(f, e) / det, r = cross(f, d) / det;
  return s >= -beyond && s <= 1 + beyond && r >= -beyond && r <= 1 + beyond;
}

/// Newton's method for c(t) = d(s), from a crossing of chords.
template <typename Curve, typename Other>
void meet(const Curve& c, const Other& d, Interval of_t, Interval of_s, double& t, double& s) {
  for (int k = 0; k < 12; ++k) {
    const CurveJet p = c(t), q = d(s);
    const Vec2 r = q.c - p.c;
    const double det = cross(p.ct, q.ct);
    if (det == 0) return;
    const double dt = cross(r, q.ct) / det, ds = cross(r, p.ct) / det;
    t = std::clamp(t + dt, of_t.a, of_t.b), s = std::clamp(s + ds, of_s.a, of_s.b);
    if (std::abs(dt) <= 1e-15 * (of_t.b - of_t.a) && std::abs(ds) <= 1e-15 * (of_s.b - of_s.a)) return;
  }
}

}  // namespace

EmbeddedCurve part_of_curve(const EmbeddedCurve& curve, double a, double b) {
  std::vector<double> t{a};
  for (const double at : curve.t)
    if (at > a && at < b) t.push_back(at);
  t.push_back(b);
  EmbeddedCurve part;
  for (std::size_t i = 0; i < t.size(); ++i) {
    part.t.push_back(t[i]), part.uv.push_back(curve.at(t[i]).c);
    if (i == 0) continue;
    // The span that holds the middle has both derivatives.
    const auto behind = std::upper_bound(curve.t.begin() + 1, curve.t.end() - 1, (t[i - 1] + t[i]) / 2);
    const auto k = static_cast<std::size_t>(behind - curve.t.begin()) - 1;
    part.start.push_back(t[i - 1] == curve.t[k] ? curve.start[k] : curve.at(t[i - 1]).ct);
    part.finish.push_back(t[i] == curve.t[k + 1] ? curve.finish[k] : curve.at(t[i]).ct);
  }
  return part;
}

std::vector<Cut> cuts_of(const Piece& piece, const CurveUses& uses, double near) {
  const std::size_t f = uses.index_of(piece.face);
  const Face& face = uses.model.faces[f];
  const double a = piece.curve.t.front(), b = piece.curve.t.back();
  const Samples own = samples_of(piece.curve, a, b);
  const auto on_piece = [&](double t) { return piece.curve.at(t); };
  const auto inside = [&](double t) { return t - a > near && b - t > near; };
  std::vector<Cut> cuts;
  const auto add = [&](double t, int curve) {
    for (const Cut& cut : cuts)
      if (std::abs(cut.t - t) <= near) return;
    if (inside(t)) cuts.push_back({t, End{surface_at(uses.cad, piece.face, want_position, on_piece(t).c).s, curve}});
  };
  double s = 0, r = 0;
  for (std::size_t c = 0; c < face.curves.size(); ++c) {
    if (face.curves[c].type != CurveType::internal) continue;
    const CurveUses::Use use{f, c};
    const Interval of_use = uses.interval(use);
    const EmbeddedCurve* known = uses.embedded(use);
    const auto on_use = [&](double t) { return uses.in_parameters(use, t); };
    Samples other;
    if (known != nullptr) {
      other = samples_of(*known, of_use.a, of_use.b);
    } else {
      constexpr int n = 2 * thresholds::embedding::samples_of_curve - 1;
      for (int i = 0; i < n; ++i) {
        const double t = i + 1 < n ? of_use.a + i * (of_use.b - of_use.a) / (n - 1) : of_use.b;
        other.t.push_back(t), other.uv.push_back(on_use(t).c);
      }
    }
    for (std::size_t i = 0; i + 1 < own.t.size(); ++i)
      for (std::size_t j = 0; j + 1 < other.t.size(); ++j)
        if (crossing(own.uv[i], own.uv[i + 1], other.uv[j], other.uv[j + 1], s, r)) {
          double t = lerp1(own.t[i], own.t[i + 1], s), t_other = lerp1(other.t[j], other.t[j + 1], r);
          meet(on_piece, on_use, {a, b}, of_use, t, t_other);
          add(t, face.curves[c].ref);
        }
  }
  for (std::size_t i = 0; i + 1 < own.t.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < own.t.size(); ++j)
      if (crossing(own.uv[i], own.uv[i + 1], own.uv[j], own.uv[j + 1], s, r)) {
        double t = lerp1(own.t[i], own.t[i + 1], s), t_other = lerp1(own.t[j], own.t[j + 1], r);
        meet(on_piece, on_piece, {own.t[i], own.t[i + 1]}, {own.t[j], own.t[j + 1]}, t, t_other);
        add(t, 0), add(t_other, 0);
      }
  std::sort(cuts.begin(), cuts.end(), [](const Cut& p, const Cut& q) { return p.t < q.t; });
  return cuts;
}

}  // namespace carreau::embedding
