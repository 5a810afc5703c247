// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/closest.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "metric/thresholds.h"
#include "periodic/thresholds.h"
#include "support/rounding_of.h"

namespace carreau {

namespace {

using namespace thresholds::periodic;

// Least-squares step of (u, v) towards a target; zero where the parametrisation is degenerate.
Vec2 step_towards(const SurfaceJet& jet, const Vec3& target) {
  const Vec3 away = target - jet.s;
  const double a = dot(jet.su, jet.su), b = dot(jet.su, jet.sv), c = dot(jet.sv, jet.sv);
  const double determinant = a * c - b * b;
  if (!(determinant > thresholds::degenerate::parallel * a * c)) return {0, 0};
  const double p = dot(jet.su, away), q = dot(jet.sv, away);
  return {(c * p - b * q) / determinant, (a * q - b * p) / determinant};
}

}  // namespace

void find_closest(Cad& cad, int face, std::span<const Vec3> targets, std::span<ClosestPoint> points) {
  std::vector<std::size_t> active(points.size());
  std::vector<Vec2> step(points.size(), Vec2(0, 0));
  for (std::size_t i = 0; i < points.size(); ++i) active[i] = i;
  std::vector<Vec2> uv;
  std::vector<SurfaceJet> jets;
  for (int round = 0; round <= rounding_of::max_steps && !active.empty(); ++round) {
    uv.clear();
    for (const std::size_t i : active) uv.push_back(points[i].uv + step[i]);
    jets.resize(uv.size());
    cad.surface(face, want_position | want_first, uv, jets);
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < active.size(); ++k) {
      const std::size_t i = active[k];
      const double distance = norm(jets[k].s - targets[i]);
      if (round > 0 && !(distance < points[i].distance)) {
        // A step that is too long is halved; one that gains nothing any more ends the search.
        if (distance <= points[i].distance * (1 + rounding_of::sizes) || round > rounding_of::halvings) continue;
        step[i] *= 0.5;
        left.push_back(i);
        continue;
      }
      points[i] = {uv[k], jets[k].s, distance};
      step[i] = step_towards(jets[k], targets[i]);
      if (distance > 0 && (step[i].x() != 0 || step[i].y() != 0)) left.push_back(i);
    }
    active.swap(left);
  }
}

CurvePoint find_closest(const CurveModel& model, const CurveUse& use, double t, double t_low, double t_high, const Vec3& target) {
  const int face = model.face_ref(use);
  CurvePoint best{t, {}, {}, -1};
  double step = 0;
  for (int round = 0; round <= rounding_of::max_steps; ++round) {
    const double at = std::clamp(best.t + step, t_low, t_high);
    const CurveJet curve = model.cad.curve(face, use.curve + 1, want_position | want_first, at);
    const SurfaceJet jet = surface_at(model.cad, face, want_position | want_first, curve.c);
    const double distance = norm(jet.s - target);
    if (best.distance >= 0 && !(distance < best.distance)) {
      if (distance <= best.distance * (1 + rounding_of::sizes) || round > rounding_of::halvings) break;
      step /= 2;
      continue;
    }
    best = {at, curve.c, jet.s, distance};
    const Vec3 tangent = curve.ct.x() * jet.su + curve.ct.y() * jet.sv;
    const double speed = dot(tangent, tangent);
    if (!(speed > 0) || distance == 0) break;
    step = dot(tangent, target - jet.s) / speed;
    if (best.t + step == best.t) break;
  }
  return best;
}

}  // namespace carreau
