// SPDX-License-Identifier: BSD-3-Clause
#include "embedding/curve_uses.h"

#include <algorithm>
#include <functional>
#include <set>

#include "embedding/thresholds.h"
#include "support/error.h"
#include "support/infinity.h"

namespace carreau::embedding {

std::size_t CurveUses::index_of(int face) const {
  for (std::size_t f = 0; f < model.faces.size(); ++f)
    if (model.faces[f].ref == face && !model.faces[f].is_wire()) return f;
  throw InvalidArgument("the model has no face with the reference " + std::to_string(face));
}

Interval CurveUses::interval(const Use& use) const {
  const Face& face = model.faces[use.face];
  const FaceCurve& curve = face.curves[use.curve];
  if (curve.part_of != 0) return {curve.part_a, curve.part_b};
  const auto own = curves.find({face.ref, static_cast<int>(use.curve) + 1});
  if (own != curves.end()) return {own->second->t.front(), own->second->t.back()};
  return cad.curve_interval(face.ref, static_cast<int>(use.curve) + 1);
}

const EmbeddedCurve* CurveUses::embedded(const Use& use) const {
  const Face& face = model.faces[use.face];
  const auto own = curves.find({face.ref, host_rank(face, use.curve)});
  return own == curves.end() ? nullptr : own->second.get();
}

CurveJet CurveUses::in_parameters(const Use& use, double t) const {
  const EmbeddedCurve* own = embedded(use);
  const Face& face = model.faces[use.face];
  return own != nullptr ? own->at(t) : cad.curve(face.ref, host_rank(face, use.curve), want_position | want_first, t);
}

CurveUses::Place CurveUses::at(const Use& use, double t) const {
  const CurveJet jet = in_parameters(use, t);
  const SurfaceJet s = surface_at(cad, model.faces[use.face].ref, want_position | want_first, jet.c);
  return {t, 0, jet.c, s.s, Vec3(jet.ct.x() * s.su + jet.ct.y() * s.sv)};
}

// Gauss and Newton's method from the nearest of some samples: places that are sought lie on the curve, or nearly.
CurveUses::Place CurveUses::nearest(const Use& use, const Vec3& x) const {
  const auto [a, b] = interval(use);
  constexpr int n = thresholds::embedding::samples_of_curve;
  const auto measured = [&](double t) {
    Place place = at(use, t);
    place.distance = norm(place.xyz - x);
    return place;
  };
  Place best;
  best.distance = infinity;
  for (int i = 0; i < n; ++i)
    if (const Place place = measured(i + 1 < n ? a + i * (b - a) / (n - 1) : b); place.distance < best.distance) best = place;
  for (int k = 0; k < 40; ++k) {
    const double speed = dot(best.tangent, best.tangent);
    if (!(speed > 0)) break;
    double way = dot(x - best.xyz, best.tangent) / speed;
    Place next;
    bool better = false;
    for (int h = 0; h < 8 && !better; ++h, way /= 2) {
      next = measured(std::clamp(best.t + way, a, b));
      better = next.distance < best.distance;
    }
    if (!better) break;
    best = next;
  }
  return best;
}

bool CurveUses::border(int face, int other, const Vec3& a, const Vec3& b, Vec3& y) const {
  const std::size_t f = index_of(face), g = index_of(other);
  std::set<int> common;
  for (const FaceCurve& curve : model.faces[f].curves) common.insert(curve.ref);
  double least = infinity;
  for (std::size_t c = 0; c < model.faces[g].curves.size(); ++c) {
    const FaceCurve& curve = model.faces[g].curves[c];
    if (!common.contains(curve.ref) || curve.type != CurveType::boundary) continue;
    const Use use{g, c};
    const auto [from, to] = interval(use);
    const auto way = [&](const Place& p) { return norm(p.xyz - a) + norm(p.xyz - b); };
    const auto slope = [&](const Place& p) {
      const Vec3 d = (p.xyz - a) / std::max(norm(p.xyz - a), 1e-300), e = (p.xyz - b) / std::max(norm(p.xyz - b), 1e-300);
      return dot(Vec3(d + e), p.tangent);
    };
    constexpr int n = thresholds::embedding::samples_of_curve;
    const double step = (to - from) / (n - 1);
    Place best = at(use, from);
    for (int i = 1; i < n; ++i)
      if (const Place place = at(use, i + 1 < n ? from + i * step : to); way(place) < way(best)) best = place;
    double low = std::max(from, best.t - step), high = std::min(to, best.t + step);
    if (slope(at(use, low)) < 0 && slope(at(use, high)) > 0) {
      for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (slope(at(use, middle)) < 0 ? low : high) = middle;
      }
      best = at(use, (low + high) / 2);
    }
    if (way(best) < least) least = way(best), y = best.xyz;
  }
  return least < infinity;
}

// Chords of a curve that leave it by at most a small share of the diagonal.
std::vector<Vec3> CurveUses::chords(const Use& use, double diagonal) const {
  const auto [a, b] = interval(use);
  std::vector<Vec3> points{at(use, a).xyz};
  const std::function<void(double, double, const Vec3&, int)> add = [&](double from, double to, const Vec3& end, int depth) {
    const double middle = (from + to) / 2;
    const Vec3 between = at(use, middle).xyz, start = points.back();
    const bool leaves = norm(between - (start + end) / 2) > thresholds::embedding::chord_of_wire * diagonal;
    if (depth < thresholds::embedding::divisions && (depth < 2 || leaves)) {
      add(from, middle, between, depth + 1);
      add(middle, to, end, depth + 1);
    } else {
      points.push_back(end);
    }
  };
  add(a, b, at(use, b).xyz, 0);
  const FaceCurve& curve = model.faces[use.face].curves[use.curve];
  if (curve.end1 == curve.end2) points.back() = points.front();
  return points;
}

}  // namespace carreau::embedding
